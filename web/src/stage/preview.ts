// Pixels of a preview, by a table of 256 colours: one for every value that a byte of it can have.

import { kCellBorder, kZone, kZoneBorder, type Preview } from 'tessera-wasm';

export type Rgba = readonly [number, number, number, number];

/** Colours as the little-endian words of ImageData; every machine that runs a browser today is little-endian. */
const wordOf = ([r, g, b, a]: Rgba) => ((a << 24) | (b << 16) | (g << 8) | r) >>> 0;

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

/** Only the borders that have `flag`, to lay over something else. */
export function borderTable(flag: typeof kCellBorder | typeof kZoneBorder, ink: Rgba): Uint32Array {
  return tableOf((value) => (value & flag ? ink : [0, 0, 0, 0]));
}

const tableOf = (colour: (value: number) => Rgba) => Uint32Array.from({ length: 256 }, (_, v) => wordOf(colour(v)));

export function pixelsOf(preview: Pick<Preview, 'cells'>, table: Uint32Array): Uint8ClampedArray<ArrayBuffer> {
  const { cells } = preview;
  const words = new Uint32Array(cells.length);
  for (let i = 0; i < cells.length; ++i) words[i] = table[cells[i]!]!;
  return new Uint8ClampedArray(words.buffer);
}
