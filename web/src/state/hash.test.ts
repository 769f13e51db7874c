import { expect, test } from 'vitest';
import { readHash, seedOf, writeHash } from './hash';

test('what is written is read again', () => {
  const hash = writeHash('pavement', 7, 'waves', { halfSide: 6.5, method: 'paper' });
  expect(hash).toBe('#technique=pavement&seed=7&sample=waves&halfSide=6.5&method=paper');
  expect(readHash(hash)).toEqual({
    technique: 'pavement',
    seed: 7,
    sample: 'waves',
    params: { halfSide: '6.5', method: 'paper' },
  });
});

test('an empty or foreign hash says nothing', () => {
  expect(readHash('')).toEqual({ technique: null, seed: null, sample: null, params: {} });
  expect(readHash('#seed=-1').seed).toBeNull();
});

test('awkward text survives', () => {
  const hash = writeHash('pavement', 1, 'a&b=c#d', { note: '<é&>' });
  expect(readHash(hash)).toMatchObject({ sample: 'a&b=c#d', params: { note: '<é&>' } });
});

test('seeds are whole numbers that JSON can carry', () => {
  expect(seedOf('0')).toBe(0);
  expect(seedOf('9007199254740991')).toBe(9007199254740991);
  expect(seedOf('9007199254740993')).toBeNull();
  expect(seedOf('1.5')).toBeNull();
  expect(seedOf('')).toBeNull();
});
