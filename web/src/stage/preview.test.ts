import { expect, test, vi } from 'vitest';

// The flags are all that is wanted of the engine here.
vi.mock('tessera-wasm', () => ({ kZone: 0x3f, kCellBorder: 0x80, kZoneBorder: 0x40 }));
const { borderTable, cellTable, picturedCells, pixelsOf, stampSites } = await import('./preview');

const palette = new Uint8Array([0, 0, 0, 200, 100, 50]);

test('cells take the colour of their zone, borders lean towards the joint', () => {
  const table = cellTable(palette, [100, 100, 100, 255]);
  const pixels = pixelsOf({ cells: new Uint8Array([0, 1, 1 | 0x80, 1 | 0x40]) }, table);
  expect([...pixels.slice(0, 4)]).toEqual([0, 0, 0, 255]);
  expect([...pixels.slice(4, 8)]).toEqual([200, 100, 50, 255]);
  expect([...pixels.slice(8, 12)]).toEqual([140, 100, 80, 255]);
  expect([...pixels.slice(12, 16)]).toEqual([125, 100, 88, 255]);
});

test('a border table is clear elsewhere', () => {
  const pixels = pixelsOf({ cells: new Uint8Array([1, 1 | 0x80, 0x40]) }, borderTable(0x40, [1, 2, 3, 4]));
  expect([...pixels]).toEqual([0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4]);
});

test('sites are dots; those that reach beyond the picture are left out', () => {
  const sites = new Float32Array([2, 4, 0, 0, 0, 0, 0, 0]);
  const preview = { width: 4, height: 4, cells: new Uint8Array(16), palette, sites };
  const pixels = pixelsOf(preview, cellTable(palette, [9, 9, 9, 255]));
  stampSites(pixels, preview, 0.5, [1, 2, 3, 255]);
  const dots = [...new Uint32Array(pixels.buffer)].map((word) => (word === 0xff030201 ? 1 : 0));
  expect(dots).toEqual([0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
});

test('cells without zones take the mean colour of the picture under them', () => {
  const b = 0x80; // 4 x 2 pixels, two cells of 2 x 2: a border right of the second column, and below as at a picture's end
  const cells = new Uint8Array([0, b, 0, 0, 0, b, 0, 0]);
  const grey = (value: number) => [value, value, value, 255];
  const picture = new Uint8ClampedArray([10, 30, 100, 100, 20, 60, 100, 140].flatMap(grey));
  const pixels = picturedCells({ cells, width: 4 }, picture, [0, 0, 0, 255]);
  expect([...pixels].filter((_, i) => i % 4 === 0)).toEqual([30, 12, 110, 110, 30, 12, 110, 110]);
  expect(pixels[3]).toBe(255);
});
