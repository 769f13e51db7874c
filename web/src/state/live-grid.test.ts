import { signal } from '@preact/signals';
import { beforeEach, expect, test, vi } from 'vitest';

/** Stands in for the engine's: two vertices a side and one in the middle, which comes to rest after a few steps. */
const engine = {
  x: 5,
  left: 0,
  begun: [] as boolean[],
  pins: '',
};
const vertices = () => Float64Array.from([0, 0, 5, 0, 10, 0, 0, 5, engine.x, 5, 10, 5, 0, 10, 5, 10, 10, 10]);
const client = {
  beginGrid: vi.fn(async (_: unknown, settled: boolean) => {
    engine.begun.push(settled);
    const laid = /^1,1:(.*),/.exec(String(params.value['pins'] ?? ''))?.[1];
    engine.x = laid ? Number(laid) : settled ? 6 : 5;
    engine.left = settled ? 0 : 8;
    const size = { across: 2, down: 2, widthMm: 10, heightMm: 10 };
    return { type: 'grid', size, vertices: vertices(), edges: { close: () => {} } };
  }),
  relaxGrid: vi.fn(async (most: number, drag: { x: number } | null) => {
    const steps = drag ? most : Math.min(most, engine.left);
    engine.left -= steps;
    engine.x = drag ? drag.x : 5 + (8 - engine.left) / 8;
    return { type: 'relaxed', vertices: vertices(), steps };
  }),
  layVertex: vi.fn(async () => ({ type: 'lain', vertices: vertices(), pins: engine.pins })),
};
const runner = {
  askingNow: vi.fn(async () => ({ job: {}, inputs: {}, drawnOnes: [] })),
  pause: vi.fn(async () => {}),
  runOwed: vi.fn(),
  runSoon: vi.fn(),
  showProblems: vi.fn(),
};
vi.mock('./page', () => ({ client }));
vi.mock('./runner', () => runner);
vi.mock('./theme', () => ({ calm: signal(false) }));
vi.mock('tessera-wasm/description', () => ({
  schema: {
    $defs: { parquetry: { properties: { pins: { title: '', description: '', type: 'string', default: '' } } } },
  },
  techniques: [],
}));
vi.mock('tessera-wasm', () => ({}));
vi.stubGlobal('requestAnimationFrame', (then: (now: number) => void) => setTimeout(() => then(performance.now()), 5));

const { undo } = await import('./edits');
const { bindGrid, chosen, drag, dragged, grid, gliding, isLaid, lay, placeOf, release, vertexAt } =
  await import('./live-grid');
const { edits, freshEdits, params, picture, technique, tool } = await import('./store');
bindGrid();

const atRest = () => vi.waitFor(() => expect(grid.value?.atRest && !gliding.value).toBe(true));
const middle = { column: 1, row: 1 };

beforeEach(async () => {
  tool.value = null;
  technique.value = 'parquetry';
  picture.value = { name: 'target.png', sample: null, width: 100, height: 100 };
  edits.value = freshEdits({ grid: 'morphed' });
  engine.begun = [];
  vi.clearAllMocks();
  tool.value = 'grid';
  await atRest();
});

test('it relaxes from an even grid, while nothing runs', () => {
  expect(runner.pause).toHaveBeenCalledTimes(1);
  expect(engine.begun).toEqual([false]);
  expect(grid.value?.steps).toBe(8);
  expect(placeOf(middle)).toEqual({ x: 6, y: 5 });
  tool.value = null;
  expect(grid.value).toBeNull();
  expect(runner.runOwed).toHaveBeenCalledTimes(1);
});

test('what is dragged is laid where the engine says, and undone', async () => {
  drag(middle, { x: 7.004, y: 5 });
  await vi.waitFor(() => expect(placeOf(middle).x).toBe(7.004));
  engine.pins = '1,1:7,5';
  await lay();
  expect(params.value['pins']).toBe('1,1:7,5');
  expect(isLaid(middle)).toBe(true);
  await vi.waitFor(() => expect(placeOf(middle).x).toBe(7));
  await atRest();
  expect(engine.begun).toEqual([false, true]); // settled: the job's
  undo();
  expect(isLaid(middle)).toBe(false);
  await vi.waitFor(() => expect(placeOf(middle).x).toBe(6));
  expect(dragged.value).toBeNull();
});

test('what cannot stay goes back, and is no step to undo', async () => {
  drag(middle, { x: 9.9, y: 5 });
  await vi.waitFor(() => expect(placeOf(middle).x).toBe(9.9));
  engine.pins = '';
  engine.x = 6;
  await lay();
  await vi.waitFor(() => expect(placeOf(middle).x).toBe(6));
  expect(edits.value.past).toEqual([]);
  expect(engine.begun).toEqual([false]);
});

test('a laid corner is let go', async () => {
  drag(middle, { x: 7, y: 5 });
  engine.pins = '1,1:7,5';
  await lay();
  release(middle);
  expect(params.value['pins']).toBeUndefined();
  await vi.waitFor(() => expect(placeOf(middle).x).toBe(6));
});

test('it is left where the pieces come from elsewhere', async () => {
  edits.value = freshEdits({ grid: 'regular' });
  expect(tool.value).toBeNull();
  expect(grid.value).toBeNull();
});

test('the nearest corner is pressed, but none of the four that stay', () => {
  expect(vertexAt({ x: 5.5, y: 4.8 }, 2)).toEqual(middle);
  expect(vertexAt({ x: 9.9, y: 5.2 }, 2)).toEqual({ column: 2, row: 1 });
  expect(vertexAt({ x: 0.1, y: 0.1 }, 2)).toBeNull();
  expect(vertexAt({ x: 3, y: 2.5 }, 2)).toBeNull();
  expect(chosen.value).toBeNull();
});
