import { expect, test } from 'vitest';
import { axisOf, pathOf, placeOn } from './chart';

test('axes hold every value between round numbers', () => {
  expect(axisOf([0.2, 0.93], 4).ticks).toEqual([0, 0.5, 1]);
  expect(axisOf([70], 5).ticks).toEqual([0, 20, 40, 60, 80]);
  expect(axisOf([1], 4).to).toBe(1);
  expect(axisOf([-0.13, 0.9], 4).from).toBe(-0.5);
  for (let seed = 1; seed < 200; ++seed) {
    const values = [3, 7, 11].map((k) => Math.tan(seed * k) * 10 ** ((seed % 9) - 4));
    const { from, to, ticks } = axisOf(values, 5);
    for (const value of [...values, 0]) {
      expect(placeOn({ from, to, ticks }, value)).toBeGreaterThanOrEqual(-1e-9);
      expect(placeOn({ from, to, ticks }, value)).toBeLessThanOrEqual(1 + 1e-9);
    }
    expect(ticks.length).toBeGreaterThan(1);
    expect(ticks.length).toBeLessThan(9);
  }
});

test('nothing to show still has an axis', () => {
  expect(axisOf([], 4).ticks.length).toBeGreaterThan(1);
  expect(axisOf([0], 4).to).toBeGreaterThan(0);
});

test('a curve goes through its points, larger values higher up', () => {
  const unit = { from: 0, to: 1, ticks: [0, 1] };
  expect(
    pathOf(
      [
        [0, 0],
        [0.5, 1],
      ],
      unit,
      unit,
      100,
      40,
    ),
  ).toBe('M0.0 40.0L50.0 0.0');
});
