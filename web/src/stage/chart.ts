// Where things lie in a chart: axes with round numbers, curves as paths.

export interface Axis {
  from: number;
  to: number;
  ticks: number[];
}

/** From 0, or below it as far as the values go, to a round number that no value exceeds; about `wanted` steps. */
export function axisOf(values: readonly number[], wanted: number): Axis {
  const least = Math.min(0, ...values);
  const most = Math.max(0, ...values);
  const step = roundStep((most - least || 1) / wanted);
  const first = Math.floor(least / step + kSlack);
  const last = Math.max(first + 1, Math.ceil(most / step - kSlack));
  const ticks = Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
  return { from: ticks[0]!, to: ticks.at(-1)!, ticks };
}

const kSlack = 1e-9;

/** 1, 2 or 5 times a power of ten, not below `least`. */
function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return ([1, 2, 5].find((factor) => factor * power >= least * (1 - kSlack)) ?? 10) * power;
}

export const placeOn = ({ from, to }: Axis, value: number): number => (value - from) / (to - from);

export type Place = readonly [x: number, y: number];

/** Through the points, in a box of that size with its origin at the top left. */
export const pathOf = (points: readonly Place[], x: Axis, y: Axis, width: number, height: number): string =>
  points
    .map(
      ([u, v], i) =>
        `${i ? 'L' : 'M'}${(placeOn(x, u) * width).toFixed(1)} ${((1 - placeOn(y, v)) * height).toFixed(1)}`,
    )
    .join('');
