import { expect, test } from 'vitest';
import { readMarks, readMasks, writeMarks } from './wood-found';

test('what was found is read', () => {
  const line = '{"panel":"oak","width":3,"height":2,"wood":[1,2,3],"marks":[[1.5,2]],"mark_px":12}';
  expect(readMasks(`${line}\n`)).toEqual([
    { width: 3, height: 2, wood: [1, 2, 3], marks: [{ x: 1.5, y: 2 }], markPx: 12 },
  ]);
});

test('marks are written and read again, none, too', () => {
  const marks = [
    { x: 10.25, y: 3 },
    { x: 0, y: 7.123 },
  ];
  expect(writeMarks(marks)).toBe('10.25:3,0:7.12');
  expect(readMarks(writeMarks(marks))).toEqual([marks[0], { x: 0, y: 7.12 }]);
  expect(readMarks(writeMarks([]))).toEqual([]);
});
