// How many pixels an inch a file says that its picture has, as the command line reads it: 0 where it does not say, or not
// the same both ways.

import { readHeader } from './picture-header';

const kInch = 0.0254; // m
const kMost = 1e5;

export function readDpi(bytes: Uint8Array): number {
  const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  try {
    switch (readHeader(bytes)?.kind) {
      case 'PNG':
        return dpiOfPng(data);
      case 'JPEG':
        return dpiOfJpeg(data);
      case 'BMP':
        return ofMetres(data.getInt32(38, true), data.getInt32(42, true));
      case 'TIFF':
        return dpiOfDirectory(data, 0);
      default:
        return 0;
    }
  } catch (error) {
    if (error instanceof RangeError) return 0; // it ends before its time; whoever decodes it will say so
    throw error;
  }
}

const sameBothWays = (x: number, y: number) => (x > 0 && y > 0 && x < kMost && Math.abs(x / y - 1) < 0.01 ? x : 0);

/** Whole pixels a metre tell a whole number of dpi only roughly. */
function ofMetres(x: number, y: number): number {
  const dpi = sameBothWays(kInch * x, kInch * y);
  return Math.abs(dpi - Math.round(dpi)) <= kInch / 2 ? Math.round(dpi) : dpi;
}

const textAt = (data: DataView, at: number, length: number) =>
  String.fromCharCode(...new Uint8Array(data.buffer, data.byteOffset + at, length));

function dpiOfPng(data: DataView): number {
  let fromExif = 0;
  for (let at = 8; at + 8 <= data.byteLength; at += 12 + data.getUint32(at)) {
    const kind = textAt(data, at + 4, 4);
    if (kind === 'pHYs' && data.getUint8(at + 16) === 1)
      return ofMetres(data.getUint32(at + 8), data.getUint32(at + 12));
    if (kind === 'eXIf') fromExif = dpiOfDirectory(data, at + 8);
    if (kind === 'IEND') break;
  }
  return fromExif;
}

function dpiOfJpeg(data: DataView): number {
  let fromExif = 0;
  for (let at = 2; data.getUint8(at) === 0xff && data.getUint8(at + 1) !== 0xda; at += 2 + data.getUint16(at + 2)) {
    const body = at + 4;
    if (data.getUint8(at + 1) === 0xe0 && textAt(data, body, 5) === 'JFIF\0') {
      const toInches = [0, 1, 2.54][data.getUint8(body + 7)] ?? 0;
      const dpi = sameBothWays(toInches * data.getUint16(body + 8), toInches * data.getUint16(body + 10));
      if (dpi > 0) return dpi;
    }
    if (data.getUint8(at + 1) === 0xe1 && textAt(data, body, 6) === 'Exif\0\0')
      fromExif = dpiOfDirectory(data, body + 6);
  }
  return fromExif;
}

/** Of TIFF, and of EXIF, which is one. */
function dpiOfDirectory(data: DataView, start: number): number {
  const little = data.getUint8(start) === 0x49;
  const word = (at: number) => data.getUint32(start + at, little);
  const short = (at: number) => data.getUint16(start + at, little);
  const rational = (at: number) => (word(at + 4) > 0 ? word(at) / word(at + 4) : 0);
  const directory = word(4);
  let [x, y, toInches] = [0, 0, 1];
  for (let i = 0; i < short(directory); ++i) {
    const entry = directory + 2 + 12 * i;
    if (short(entry) === 0x011a) x = rational(word(entry + 8));
    if (short(entry) === 0x011b) y = rational(word(entry + 8));
    if (short(entry) === 0x0128) toInches = [0, 0, 1, 2.54][short(entry + 8)] ?? 0;
  }
  return sameBothWays(x * toInches, y * toInches);
}
