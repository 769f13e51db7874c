import { expect, test } from 'vitest';
import { curvePath, placeOf, roundSizes, sizeCurve } from './sizes';

test('round sizes enclose what they are for', () => {
  expect(roundSizes(3, 42)).toEqual([2, 5, 10, 20, 50]);
  expect(roundSizes(1, 10)).toEqual([1, 2, 5, 10]);
  expect(roundSizes(0.03, 0.04)).toEqual([0.02, 0.05]);
  expect(roundSizes(7, 7)).toEqual([5, 10]);
  expect(roundSizes(5, 5)).toEqual([5, 10]);
});

test('a curve climbs from nothing to all', () => {
  const curve = sizeCurve([40, 10, 20, 10, 0])!;
  expect(curve.ticks).toEqual([10, 20, 50]);
  expect(curve.steps.map(([size]) => size)).toEqual([10, 10, 20, 40]);
  expect(curve.steps.at(-1)![1]).toBe(1);
  expect(placeOf(curve, 10)).toBe(0);
  expect(placeOf(curve, 50)).toBe(1);
  expect(placeOf(curve, Math.sqrt(500))).toBeCloseTo(0.5);
  expect(curvePath(curve, 100, 50)).toMatch(/^M0 50\.0H0\.0V37\.5H0\.0V25\.0.*V0\.0H100$/);
});

test('no grains, no curve', () => {
  expect(sizeCurve([])).toBeNull();
  expect(sizeCurve(new Float32Array([0]))).toBeNull();
});
