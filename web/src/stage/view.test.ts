import { expect, test } from 'vitest';
import { fit, panBy, toPicture, zoomAt } from './view';

const picture = { width: 1000, height: 500 };
const stage = { width: 800, height: 600 };

test('fit centres the whole picture', () => {
  expect(fit(picture, stage, 0)).toEqual({ scale: 0.8, x: 0, y: 100 });
  expect(fit(picture, stage, 20)).toEqual({ scale: 0.76, x: 20, y: 110 });
});

test('fit does not blow a tiny picture up without end', () => {
  expect(fit({ width: 2, height: 2 }, stage, 0).scale).toBe(4);
});

test('zoom keeps the point under the pointer', () => {
  const view = fit(picture, stage, 0);
  const at = { x: 300, y: 250 };
  const before = toPicture(view, at);
  const after = toPicture(zoomAt(view, at, 3, picture, stage), at);
  expect(after.x).toBeCloseTo(before.x);
  expect(after.y).toBeCloseTo(before.y);
});

test('zoom has ends', () => {
  const view = fit(picture, stage, 0);
  const at = { x: 400, y: 300 };
  expect(zoomAt(view, at, 1e9, picture, stage).scale).toBe(64);
  expect(zoomAt(view, at, 1e-9, picture, stage).scale).toBeCloseTo(0.4);
});

test('the picture cannot be lost', () => {
  const view = panBy(fit(picture, stage, 0), 1e6, -1e6, picture, stage);
  expect(view.x).toBe(752);
  expect(view.y).toBe(48 - 400);
});
