import { expect, test } from 'vitest';
import { pinOf, readPins, withoutPin, writePins } from './pins';

const text = '3,4:123.5,87.2; 0,12:0,88';

test('what is read is written', () => {
  expect(readPins(text)).toEqual([
    { column: 3, row: 4, x: 123.5, y: 87.2 },
    { column: 0, row: 12, x: 0, y: 88 },
  ]);
  expect(writePins(readPins(text))).toBe(text);
  expect(readPins(' ;\n')).toEqual([]);
});

test('a corner is let go, and no other', () => {
  expect(pinOf(text, { column: 3, row: 4 })?.x).toBe(123.5);
  expect(pinOf(text, { column: 4, row: 3 })).toBeUndefined();
  expect(withoutPin(text, { column: 3, row: 4 })).toBe('0,12:0,88');
  expect(withoutPin(text, { column: 4, row: 3 })).toBe(text);
  expect(withoutPin('3,4:1,2', { column: 3, row: 4 })).toBe('');
});
