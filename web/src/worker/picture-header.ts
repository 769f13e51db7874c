// What kind of picture some bytes are, and its size, before memory is taken for it.

export type PictureKind = 'PNG' | 'JPEG' | 'WebP' | 'BMP' | 'GIF' | 'TIFF';

export interface PictureHeader {
  kind: PictureKind;
  /** 0 where the header does not tell. */
  width: number;
  height: number;
}

export function readHeader(bytes: Uint8Array): PictureHeader | null {
  const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const text = (at: number, length: number) => String.fromCharCode(...bytes.subarray(at, at + length));
  const of = (kind: PictureKind, width = 0, height = 0): PictureHeader => ({ kind, width, height });
  const { length } = bytes;
  if (length >= 24 && text(1, 3) === 'PNG') return of('PNG', data.getUint32(16), data.getUint32(20));
  if (length >= 10 && text(0, 4) === 'GIF8') return of('GIF', data.getUint16(6, true), data.getUint16(8, true));
  if (length >= 26 && text(0, 2) === 'BM') {
    return of('BMP', Math.abs(data.getInt32(18, true)), Math.abs(data.getInt32(22, true)));
  }
  if (length >= 30 && text(0, 4) === 'RIFF' && text(8, 4) === 'WEBP')
    return of('WebP', ...webpSize(data, text(12, 4)));
  if (length >= 4 && bytes[0] === 0xff && bytes[1] === 0xd8) return of('JPEG', ...jpegSize(data));
  if (length >= 8 && ['II*\0', 'MM\0*'].includes(text(0, 4))) return of('TIFF');
  return null;
}

function webpSize(data: DataView, chunk: string): [number, number] {
  if (chunk === 'VP8X') {
    const triple = (at: number) => data.getUint16(at, true) | (data.getUint8(at + 2) << 16);
    return [triple(24) + 1, triple(27) + 1];
  }
  if (chunk === 'VP8L') {
    const bits = data.getUint32(21, true);
    return [(bits & 0x3fff) + 1, ((bits >>> 14) & 0x3fff) + 1];
  }
  return [data.getUint16(26, true) & 0x3fff, data.getUint16(28, true) & 0x3fff];
}

/** The first frame header: SOF0 to SOF15 but for the three markers in between that are none. */
function jpegSize(data: DataView): [number, number] {
  for (let at = 2; at + 9 < data.byteLength;) {
    if (data.getUint8(at) !== 0xff) return [0, 0];
    const marker = data.getUint8(at + 1);
    if (marker === 0xff) {
      ++at;
    } else if (marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker)) {
      return [data.getUint16(at + 7), data.getUint16(at + 5)];
    } else {
      at += 2 + data.getUint16(at + 2);
    }
  }
  return [0, 0];
}
