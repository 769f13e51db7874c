import { beforeEach, expect, test, vi } from 'vitest';

const runSoon = vi.fn();
vi.mock('./runner', () => ({ runSoon }));
vi.mock('tessera-wasm/description', () => ({ schema: { $defs: {} }, techniques: [] }));
vi.mock('tessera-wasm', () => ({}));
const { kNothingDrawn } = await import('./drawn');
const { changeDrawn, changeSeed, dropDrawn, endStep, redo, undo } = await import('./edits');
const { drawn, edits, freshEdits, seed } = await import('./store');

const line = [
  { x: 0, y: 0 },
  { x: 9, y: 9 },
];

beforeEach(() => {
  edits.value = freshEdits();
  endStep();
  runSoon.mockClear();
});

test('what is drawn is undone and redone in turn with the rest, and runs', () => {
  changeDrawn({ guides: [line] });
  changeSeed(7);
  expect(runSoon).toHaveBeenCalledTimes(2);
  undo();
  expect([seed.value, drawn.value.guides]).toEqual([1, [line]]);
  undo();
  expect(drawn.value.guides).toEqual([]);
  redo();
  expect(drawn.value.guides).toEqual([line]);
  expect(runSoon).toHaveBeenCalledTimes(5);
});

test('all steps of dragging a point are one', () => {
  changeDrawn({ guides: [line] });
  for (let x = 1; x <= 5; ++x) changeDrawn({ guides: [[{ x, y: 0 }, line[1]!]] }, 'guides');
  endStep();
  expect(drawn.value.guides[0]![0]).toEqual({ x: 5, y: 0 });
  undo();
  expect(drawn.value.guides).toEqual([line]);
});

test('another picture takes nothing over, and has nothing to take back where nothing was drawn', () => {
  dropDrawn();
  expect(edits.value.past).toEqual([]);
  changeDrawn({ regions: [{ width: 5, colour: '#0000ff', points: line }] });
  dropDrawn();
  expect(drawn.value).toEqual(kNothingDrawn);
});
