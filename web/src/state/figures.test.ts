import { expect, test } from 'vitest';
import { figuresOf, withError } from './figures';

test('an error says how many digits are worth showing', () => {
  expect(withError({ mean: 5.98735, error: 0.0642407 })).toBe('5.987 ± 0.064');
  expect(withError({ mean: 562.81, error: 13.1349 })).toBe('563 ± 13');
  expect(withError({ mean: 576, error: 0 })).toBe('576');
  expect(withError({ mean: 1496.49, error: 0.00095 })).toBe('1,496');
});

test('cells stand beside what is expected of them, where it is known', () => {
  const moment = { mean: 6, error: 0.1, variance: 1 };
  const rows = figuresOf({
    kind: 'cells',
    cells_per_area: 0.0018,
    area: { ...moment, expected: 576 },
    perimeter: moment,
    sides: moment,
  });
  expect(rows.map(({ expected }) => expected)).toEqual(['', '576', '', '']);
  expect(rows[0]?.measured).toBe('1.8');
});

test('a picture is told by its colours', () => {
  const classes = Array.from({ length: 9 }, () => ({ colour: '#102030', share: 0.25, patch_width_px: 12.5 }));
  const rows = figuresOf({ kind: 'picture', classes });
  expect(rows.length).toBe(6);
  expect(rows[0]).toMatchObject({ colour: '#102030', measured: '25%, 12.5 px wide' });
});
