// Pixels of a preview, by a table of 256 colours: one for every value that a byte of it can have.

import { kCellBorder, kZone, kZoneBorder, type Preview } from 'tessera-wasm';

export type Rgba = readonly [number, number, number, number];

/** Colours as the little-endian words of ImageData; every machine that runs a browser today is little-endian. */
const wordOf = ([r, g, b, a]: Rgba) => ((a << 24) | (b << 16) | (g << 8) | r) >>> 0;

const kRoomy = 100; // px a cell

const mix = (from: number, to: number, part: number) => Math.round(from + (to - from) * part);

/** Cells in the colour of their zone, with joints between them. */
export function cellTable(palette: Uint8Array, joint: Rgba): Uint32Array {
  return tableOf((value) => {
    const zone = value & kZone;
    const part = value & kZoneBorder ? 0.75 : value & kCellBorder ? 0.6 : 0;
    const channel = (i: 0 | 1 | 2) => mix(palette[3 * zone + i] ?? 0, joint[i], part);
    return [channel(0), channel(1), channel(2), 255];
  });
}

/**
 * Cells in the mean colour of what they lie on, with joints between them: for a diagram without zones, whose pieces take
 * their colours from the picture. `picture`: RGBA of the preview's size.
 */
export function picturedCells(
  { cells, width }: Pick<Preview, 'cells' | 'width'>,
  picture: Uint8ClampedArray,
  joint: Rgba,
): Uint8ClampedArray<ArrayBuffer> {
  const cell = cellsApart(cells, width);
  const sums = new Uint32Array(4 * cells.length);
  for (let i = 0; i < cells.length; ++i) {
    const at = 4 * cell[i]!;
    for (let c = 0; c < 3; ++c) sums[at + c] = sums[at + c]! + picture[4 * i + c]!;
    sums[at + 3] = sums[at + 3]! + 1;
  }
  const pixels = new Uint8ClampedArray(4 * cells.length);
  for (let i = 0; i < cells.length; ++i) {
    const at = 4 * cell[i]!;
    const part = cells[i]! & kCellBorder ? 0.6 : 0;
    for (let c = 0; c < 3; ++c) pixels[4 * i + c] = mix(sums[at + c]! / sums[at + 3]!, joint[c]!, part);
    pixels[4 * i + 3] = 255;
  }
  return pixels;
}

/** A number for each pixel, the same throughout a cell: pixels are joined where no border lies between them. */
function cellsApart(cells: Uint8Array, width: number): Uint32Array {
  const root = new Uint32Array(cells.length);
  const find = (i: number): number => {
    while (root[i] !== i) i = root[i] = root[root[i]!]!;
    return i;
  };
  for (let i = 0; i < cells.length; ++i) {
    const left = i % width > 0 && !(cells[i - 1]! & kCellBorder);
    const above = i >= width && !(cells[i - width]! & kCellBorder);
    root[i] = left ? find(i - 1) : above ? find(i - width) : i;
    if (left && above) {
      const [a, b] = [root[i]!, find(i - width)];
      root[Math.max(a, b)] = Math.min(a, b);
      root[i] = Math.min(a, b);
    }
  }
  for (let i = 0; i < cells.length; ++i) root[i] = find(i);
  return root;
}

/** Only the borders that have `flag`, to lay over something else. */
export function borderTable(flag: typeof kCellBorder | typeof kZoneBorder, ink: Rgba): Uint32Array {
  return tableOf((value) => (value & flag ? ink : [0, 0, 0, 0]));
}

const tableOf = (colour: (value: number) => Rgba) => Uint32Array.from({ length: 256 }, (_, v) => wordOf(colour(v)));

/** A dot at every site: a pixel, or 2 x 2 where the cells have room for it. `step`: preview pixels to one of the coordinates that sites are in. */
export function stampSites(pixels: Uint8ClampedArray<ArrayBuffer>, preview: Preview, step: number, ink: Rgba): void {
  const { width, height, sites } = preview;
  const words = new Uint32Array(pixels.buffer);
  const word = wordOf(ink);
  const large = (4 * width * height) / Math.max(1, sites.length) > kRoomy;
  for (let i = 0; i + 3 < sites.length; i += 4) {
    const x = Math.round(sites[i]! * step) - 1;
    const y = Math.round(sites[i + 1]! * step) - 1;
    if (x < 0 || y < 0 || x + 1 >= width || y + 1 >= height) continue;
    const at = y * width + x;
    words[at] = word;
    if (large) words[at + 1] = words[at + width] = words[at + width + 1] = word;
  }
}

export function pixelsOf(preview: Pick<Preview, 'cells'>, table: Uint32Array): Uint8ClampedArray<ArrayBuffer> {
  const { cells } = preview;
  const words = new Uint32Array(cells.length);
  for (let i = 0; i < cells.length; ++i) words[i] = table[cells[i]!]!;
  return new Uint8ClampedArray(words.buffer);
}
