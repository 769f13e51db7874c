import { expect, test, vi } from 'vitest';

vi.mock('./page', () => ({ client: {} }));
vi.mock('./runner', () => ({ runSoon: () => {} }));
vi.mock('tessera-wasm/description', () => ({ schema: { $defs: {} }, techniques: [] }));
vi.mock('tessera-wasm', () => ({}));
const { sideBySide } = await import('./targets');

test('targets lie side by side, as long along their shorter sides', () => {
  const first = { width: 120, height: 100 };
  expect(sideBySide([first], 1)).toEqual(first);
  expect(sideBySide([first], 3)).toEqual({ width: 360, height: 100 });
  expect(sideBySide([first, { width: 10, height: 25 }], 2)).toEqual({ width: 440, height: 250 });
});
