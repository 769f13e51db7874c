// Corrections of what was found in a photo, in the words of the parameter that holds them: "merge 120,44 130,60;
// delete 5,8". Places are px of the photo.

import type { Point } from '../stage/view';

export type Correction = 'merge' | 'split' | 'delete' | 'add';

const kFewest: Readonly<Record<Correction, number>> = { merge: 2, split: 2, delete: 1, add: 3 };

const place = ({ x, y }: Point) => `${Number(x.toFixed(1))},${Number(y.toFixed(1))}`;

/** The text with one more at its end; the same where the places are too few. */
export function withCorrection(text: string, what: Correction, places: readonly Point[]): string {
  if (places.length < kFewest[what]) return text;
  const before = text.trim().replace(/;$/, '');
  return `${before}${before && '; '}${what} ${places.map(place).join(' ')}`;
}

/** How many there are; remarks are none. */
export const countCorrections = (text: string): number =>
  text.split(/[;\n]/).filter((part) => part.trim() && !part.trim().startsWith('#')).length;

/** Pixels to a metre where a line of so many pixels is so many millimetres long; null where that cannot be. */
export function pixelsPerMetre(from: Point, to: Point, millimetres: number): number | null {
  const pixels = Math.hypot(to.x - from.x, to.y - from.y);
  const value = Number(((1000 * pixels) / millimetres).toPrecision(6));
  return millimetres > 0 && pixels > 0 && Number.isFinite(value) ? value : null;
}
