import { expect, test } from 'vitest';
import { simplified, smoothPath } from './curve';

const wave = Array.from({ length: 201 }, (_, x) => ({ x, y: 30 * Math.sin(x / 20) }));

test('a line drawn by hand needs few points, none of them far from it', () => {
  const few = simplified(wave, 2);
  expect(few.length).toBeLessThan(20);
  expect(few[0]).toEqual(wave[0]);
  expect(few.at(-1)).toEqual(wave.at(-1));
  for (const { x, y } of wave) {
    const next = few.findIndex((p) => p.x >= x);
    const [a, b] = [few[Math.max(0, next - 1)]!, few[next]!];
    const on = b.x > a.x ? a.y + ((x - a.x) / (b.x - a.x)) * (b.y - a.y) : a.y;
    expect(Math.abs(on - y)).toBeLessThan(2 * Math.hypot(1, 30 / 20)); // above, not square to it
  }
});

test('a straight line is its ends, also where it goes back', () => {
  const straight = [0, 10, 4, 20].map((x) => ({ x, y: 0 }));
  expect(simplified(straight, 1)).toEqual([straight[0], straight[3]]);
  const back = [0, 40, 0].map((x) => ({ x, y: 0 }));
  expect(simplified(back, 1)).toEqual(back);
});

test('a smooth path goes through its points; straight where they are in line', () => {
  expect(smoothPath([])).toBe('');
  expect(smoothPath([{ x: 1, y: 2 }])).toBe('M1 2L1 2');
  const path = smoothPath([0, 6, 12].map((x) => ({ x, y: x })));
  expect(path).toBe('M0 0C1 1 4 4 6 6C8 8 11 11 12 12');
});
