// Pictures from files. What the browser decodes, it decodes; TIFF and numbers of 16 bits have decoders of their own,
// loaded when one comes.

import type { Picture } from 'tessera-wasm';
import { readHeader } from './picture-header';
import { readDpi } from './resolution';

const kMaxPixels = 100_000_000;
const kMaxShown = 4096; // px a side; no screen shows more

/** A message that the page shows as it is. */
export class PictureError extends Error {}

export interface Opened {
  width: number;
  height: number;
  /** Pixels an inch that the file tells; 0: it does not. */
  dpi: number;
  /** To look at; as transparent as the file. */
  bitmap: ImageBitmap;
  /** Once only. They take their time, and nobody needs them before a job. */
  pixels(): Picture;
}

/** What pixels are, if not colours over white: numbers, which may be too large for a canvas; colours with their opacity. */
export type PixelKind = 'colours' | 'numbers' | 'see-through';

export async function open(blob: Blob, name: string, kind: PixelKind = 'colours'): Promise<Opened> {
  const bytes = new Uint8Array(await blob.arrayBuffer());
  if (bytes.length === 0) throw new PictureError(`“${name}” is empty. Choose another file.`);
  const header = readHeader(bytes);
  if (!header) {
    throw new PictureError(`“${name}” is not a picture that can be read. Use PNG, JPEG, WebP, BMP, GIF or TIFF.`);
  }
  refuseTooLarge(name, header.width, header.height);
  try {
    if (kind === 'numbers' && isDeepGrey(bytes)) return await openNumbers(bytes);
    const opened = await (header.kind === 'TIFF' ? openTiff(bytes, name) : openByBrowser(blob, name, kind));
    return { ...opened, dpi: readDpi(bytes) };
  } catch (error) {
    if (error instanceof PictureError) throw error;
    throw new PictureError(`“${name}” is a damaged ${header.kind} file. Save it again, or choose another.`);
  }
}

function refuseTooLarge(name: string, width: number, height: number): void {
  if (width * height <= kMaxPixels) return;
  const size = Math.round((width * height) / 1e6).toLocaleString('en');
  throw new PictureError(
    `“${name}” has ${size} megapixels (${width} × ${height}); 100 are the most. Make it smaller.`,
  );
}

async function openByBrowser(blob: Blob, name: string, kind: PixelKind): Promise<Opened> {
  const bitmap = await createImageBitmap(blob, { imageOrientation: 'from-image', colorSpaceConversion: 'none' });
  const { width, height } = bitmap;
  refuseTooLarge(name, width, height);
  const pixels = () => pixelsOf(bitmap, 1, kind === 'see-through');
  return { width, height, dpi: 0, bitmap: await toLookAt(bitmap, width, height), pixels };
}

async function openTiff(bytes: Uint8Array, name: string): Promise<Opened> {
  const { decode: readDirectories, decodeImage, toRGBA8 } = await import('utif2');
  const buffer = bytes.slice().buffer;
  const first = readDirectories(buffer)[0];
  if (!first) throw new PictureError(`“${name}” holds no picture.`);
  refuseTooLarge(name, Number(first['t256']), Number(first['t257']));
  decodeImage(buffer, first);
  const { width, height } = first;
  const data = toRGBA8(first);
  if (!(width > 0 && height > 0) || data.length !== 4 * width * height) throw new Error('damaged');
  return openPixels(new Uint8ClampedArray(data), width, height);
}

export async function openPixels(
  data: Uint8ClampedArray<ArrayBuffer>,
  width: number,
  height: number,
): Promise<Opened> {
  const image = new ImageData(data, width, height);
  return { width, height, dpi: 0, bitmap: await toLookAt(image, width, height), pixels: () => image };
}

/** A PNG of 16 bits of grey. */
const isDeepGrey = (bytes: Uint8Array) => bytes[0] === 0x89 && bytes[24] === 16 && bytes[25] === 0;

/** The high byte as green, the low one as blue: the same pixels as the command line makes of such a file. */
async function openNumbers(bytes: Uint8Array): Promise<Opened> {
  const { decode } = await import('fast-png');
  const { width, height, data: numbers } = decode(bytes, { checkCrc: true });
  const data = new Uint8ClampedArray(4 * width * height);
  for (let i = 0; i < width * height; ++i) {
    const number = numbers[i] ?? 0;
    data[4 * i + 1] = number >> 8;
    data[4 * i + 2] = number & 255;
    data[4 * i + 3] = 255;
  }
  return openPixels(data, width, height);
}

/** Over white, if not see-through, and scaled; the bitmap is used up. */
function pixelsOf(bitmap: ImageBitmap, scale: number, seeThrough = false): Picture {
  const width = Math.max(1, Math.round(bitmap.width * scale));
  const height = Math.max(1, Math.round(bitmap.height * scale));
  const context = new OffscreenCanvas(width, height).getContext('2d', {
    alpha: seeThrough,
    willReadFrequently: true,
  });
  if (!context) throw new PictureError(`There is not enough memory for a picture of ${width} × ${height} pixels.`);
  context.fillStyle = '#fff';
  if (!seeThrough) context.fillRect(0, 0, width, height);
  context.imageSmoothingEnabled = scale !== 1; // it takes its time even where there is nothing to smooth
  context.imageSmoothingQuality = 'high';
  context.drawImage(bitmap, 0, 0, width, height);
  bitmap.close();
  return context.getImageData(0, 0, width, height);
}

export function toLookAt(
  image: ImageBitmap | ImageData,
  width: number,
  height: number,
  most = kMaxShown,
): Promise<ImageBitmap> {
  const part = Math.min(1, most / Math.max(width, height));
  if (part === 1) return createImageBitmap(image);
  return createImageBitmap(image, {
    resizeWidth: Math.max(1, Math.round(width * part)),
    resizeHeight: Math.max(1, Math.round(height * part)),
    resizeQuality: 'high',
  });
}

export async function scaled(picture: Picture, scale: number): Promise<Picture> {
  const { data, width, height } = picture;
  const image = new ImageData(new Uint8ClampedArray(data.buffer as ArrayBuffer, data.byteOffset), width, height);
  return pixelsOf(await createImageBitmap(image), scale);
}
