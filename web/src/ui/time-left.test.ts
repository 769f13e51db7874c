import { expect, test } from 'vitest';
import { timeLeft } from './time-left';

test('the rest follows from what is done', () => {
  expect(timeLeft(0.25, 5000)).toBe('15 s left');
  expect(timeLeft(0.1, 60_000)).toBe('9 min left');
});

test('nothing is said too early, or about less than a second', () => {
  expect(timeLeft(0.01, 5000)).toBe('');
  expect(timeLeft(0.5, 100)).toBe('');
  expect(timeLeft(0.95, 5000)).toBe('');
});
