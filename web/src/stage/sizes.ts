// Grain sizes as field science draws them: what part of the grains is finer than a size, over a logarithmic axis.

export interface SizeCurve {
  /** The axis' ends, mm: round numbers around all sizes. */
  from: number;
  to: number;
  /** Sizes to write below it, mm. */
  ticks: readonly number[];
  /** Size in mm, and the part of the grains that are no larger; from the finest, both never falling. */
  steps: readonly (readonly [number, number])[];
}

const kRound = [1, 2, 5];

/** Round numbers of which the first is at most `low`, the last at least `high`; both above 0. */
export function roundSizes(low: number, high: number): number[] {
  const sizes: number[] = [];
  const decade = Math.floor(Math.log10(low));
  for (let power = decade; power <= Math.ceil(Math.log10(high)); ++power) {
    for (const digit of kRound) sizes.push(Number(`${digit}e${power}`));
  }
  const first = sizes.findLastIndex((size) => size <= low);
  const last = sizes.findIndex((size) => size >= high);
  return sizes.slice(Math.max(0, first), Math.max(first + 1, last) + 1);
}

/** Null where there are no sizes. */
export function sizeCurve(millimetres: ArrayLike<number>): SizeCurve | null {
  const sizes = Array.from(millimetres)
    .filter((size) => size > 0)
    .sort((a, b) => a - b);
  const [finest, coarsest] = [sizes[0], sizes.at(-1)];
  if (finest === undefined || coarsest === undefined) return null;
  const ticks = roundSizes(finest, coarsest);
  return {
    from: ticks[0]!,
    to: ticks.at(-1)!,
    ticks,
    steps: sizes.map((size, i) => [size, (i + 1) / sizes.length] as const),
  };
}

/** Where a size lies on the axis, 0 to 1. */
export const placeOf = ({ from, to }: SizeCurve, size: number): number =>
  Math.min(1, Math.max(0, Math.log(size / from) / Math.log(to / from)));

/** The curve as a path in a box of that size, its origin at the top left: up at each grain, along to the next. */
export function curvePath(curve: SizeCurve, width: number, height: number): string {
  const x = (size: number) => (placeOf(curve, size) * width).toFixed(1);
  const y = (part: number) => ((1 - part) * height).toFixed(1);
  const words = [`M0 ${y(0)}`];
  for (const [size, part] of curve.steps) words.push(`H${x(size)}V${y(part)}`);
  return `${words.join('')}H${width}`;
}
