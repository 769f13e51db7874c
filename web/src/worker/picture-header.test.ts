import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';
import { readHeader } from './picture-header';

const bytes = (...parts: (string | number[])[]) =>
  Uint8Array.from(parts.flatMap((p) => (typeof p === 'string' ? [...p].map((c) => c.charCodeAt(0)) : p)));
const zeros = (n: number) => Array<number>(n).fill(0);

test('a real PNG', () => {
  const waves = readFileSync(new URL('../../../public/samples/waves.png', import.meta.url));
  expect(readHeader(waves)).toEqual({ kind: 'PNG', width: 1024, height: 1024 });
});

test('JPEG: sizes stand in the frame header, after other segments', () => {
  const jpeg = bytes([0xff, 0xd8, 0xff, 0xe0, 0, 4, 0, 0, 0xff, 0xc2, 0, 11, 8, 0x01, 0x02, 0x03, 0x04, 3, 0, 0]);
  expect(readHeader(jpeg)).toEqual({ kind: 'JPEG', width: 0x304, height: 0x102 });
});

test('GIF, BMP and TIFF', () => {
  expect(readHeader(bytes('GIF89a', [0x20, 3, 0x58, 2]))).toEqual({ kind: 'GIF', width: 800, height: 600 });
  const bmp = bytes('BM', zeros(16), [0x20, 3, 0, 0], [0xa8, 0xfd, 0xff, 0xff]); // rows from the top: height below zero
  expect(readHeader(bmp)).toEqual({ kind: 'BMP', width: 800, height: 600 });
  expect(readHeader(bytes('II*\0', zeros(4)))).toMatchObject({ kind: 'TIFF' });
});

test('the three kinds of WebP', () => {
  const webp = (chunk: string, ...rest: number[]) => bytes('RIFF', zeros(4), 'WEBP', chunk, rest, zeros(16));
  expect(readHeader(webp('VP8X', ...zeros(8), 0x1f, 3, 0, 0x57, 2, 0))).toMatchObject({ width: 800, height: 600 });
  expect(readHeader(webp('VP8 ', ...zeros(10), 0x20, 3, 0x58, 2))).toMatchObject({ width: 800, height: 600 });
  expect(readHeader(webp('VP8L', ...zeros(4), 0x2f, 0x1f, 0xc3, 0x95, 0))).toMatchObject({ width: 800, height: 600 });
});

test('anything else is no picture', () => {
  expect(readHeader(bytes('<svg xmlns="http://www.w3.org/2000/svg"/>'))).toBeNull();
  expect(readHeader(new Uint8Array())).toBeNull();
  expect(readHeader(bytes([0xff, 0xd8, 0xff]))).toBeNull();
});
