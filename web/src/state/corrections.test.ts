import { expect, test } from 'vitest';
import { countCorrections, pixelsPerMetre, withCorrection } from './corrections';

const [a, b, c] = [
  { x: 1.04, y: 2 },
  { x: 30.26, y: 4.999 },
  { x: 5, y: 6 },
];

test('corrections follow each other in the words of the parameter', () => {
  const one = withCorrection('', 'delete', [a]);
  expect(one).toBe('delete 1,2');
  const two = withCorrection(one, 'merge', [a, b]);
  expect(two).toBe('delete 1,2; merge 1,2 30.3,5');
  expect(withCorrection(`${two};`, 'add', [a, b, c])).toBe(`${two}; add 1,2 30.3,5 5,6`);
});

test('too few places correct nothing', () => {
  expect(withCorrection('', 'merge', [a])).toBe('');
  expect(withCorrection('delete 1,1', 'split', [a])).toBe('delete 1,1');
  expect(withCorrection('', 'add', [a, b])).toBe('');
});

test('corrections are counted, remarks and nothing are not', () => {
  expect(countCorrections('')).toBe(0);
  expect(countCorrections('# mine\nmerge 1,2 3,4; delete 5,6;\n')).toBe(2);
});

test('a line of a known length gives the scale', () => {
  expect(pixelsPerMetre({ x: 0, y: 0 }, { x: 30, y: 40 }, 100)).toBe(500);
  expect(pixelsPerMetre(a, a, 100)).toBeNull();
  expect(pixelsPerMetre(a, b, 0)).toBeNull();
  expect(pixelsPerMetre(a, b, Number.NaN)).toBeNull();
});
