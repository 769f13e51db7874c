// What the engine's question "masks" is answered with, and marks as the parameter "panels" has them.

import type { Point } from '../stage/view';

export interface FoundMask {
  width: number;
  height: number;
  /** Row by row: so many pixels are no wood, so many after these are, and so on in turn. */
  wood: readonly number[];
  /** Middles of its marks, px of the scan, and their diameter. */
  marks: readonly Point[];
  markPx: number;
}

/** A line of JSON a panel. */
export const readMasks = (text: string): FoundMask[] =>
  text
    .split('\n')
    .filter(Boolean)
    .map((line) => {
      const { width, height, wood, marks, mark_px: markPx } = JSON.parse(line);
      return { width, height, wood, markPx, marks: marks.map(([x, y]: [number, number]) => ({ x, y })) };
    });

const kNone = 'none';

export const writeMarks = (marks: readonly Point[]): string =>
  marks.map(({ x, y }) => `${Number(x.toFixed(2))}:${Number(y.toFixed(2))}`).join(',') || kNone;

export const readMarks = (text: string): Point[] =>
  text === kNone
    ? []
    : text.split(',').map((pair) => {
        const [x = 0, y = 0] = pair.split(':').map(Number);
        return { x, y };
      });
