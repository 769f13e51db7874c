import { expect, test } from 'vitest';
import { readDpi } from './resolution';

const bytes = (...parts: (number[] | string)[]) =>
  Uint8Array.from(parts.flatMap((part) => (typeof part === 'string' ? [...part].map((c) => c.charCodeAt(0)) : part)));
const big = (value: number) => [value >>> 24, (value >>> 16) & 255, (value >>> 8) & 255, value & 255];

const png = (x: number, y: number, unit = 1) =>
  bytes(
    [0x89],
    'PNG\r\n\x1a\n',
    big(13),
    'IHDR',
    big(4),
    big(4),
    [8, 2, 0, 0, 0],
    big(0),
    big(9),
    'pHYs',
    big(x),
    big(y),
    [unit, ...big(0), ...big(0)],
    'IEND',
    big(0),
  );

const jfif = (unit: number, x: number, y: number) =>
  bytes([0xff, 0xd8, 0xff, 0xe0, 0, 16], 'JFIF\0', [
    1,
    1,
    unit,
    x >> 8,
    x & 255,
    y >> 8,
    y & 255,
    0,
    0,
    0xff,
    0xda,
    0,
    2,
  ]);

const little = (value: number) => big(value).reverse();
const tiff = (unit: number) =>
  bytes(
    'II*\0',
    little(8),
    [3, 0],
    [0x1a, 1, 5, 0],
    little(1),
    little(50),
    [0x1b, 1, 5, 0],
    little(1),
    little(50),
    [0x28, 1, 3, 0],
    little(1),
    [unit, 0, 0, 0],
    little(0),
    little(600),
    little(2),
  );

test('PNG, in pixels a metre', () => {
  expect(readDpi(png(11811, 11811))).toBe(300);
  expect(readDpi(png(3937, 3937))).toBe(100);
  expect(readDpi(png(11811, 5906))).toBe(0);
  expect(readDpi(png(11811, 11811, 0))).toBe(0);
});

test('JPEG, in inches or centimetres', () => {
  expect(readDpi(jfif(1, 600, 600))).toBe(600);
  expect(readDpi(jfif(2, 100, 100))).toBe(254);
  expect(readDpi(jfif(0, 1, 1))).toBe(0);
});

test('TIFF and EXIF', () => {
  expect(readDpi(tiff(2))).toBe(300);
  expect(readDpi(tiff(3))).toBe(762);
  expect(readDpi(tiff(1))).toBe(0);
});

test('what ends too early says nothing', () => {
  for (const whole of [png(11811, 11811), jfif(1, 600, 600), tiff(2)])
    for (let length = 0; length < whole.length; ++length)
      expect(length < 14 ? [0] : [0, readDpi(whole)]).toContain(readDpi(whole.subarray(0, length)));
});
