// Pictures from files. What the browser decodes, it decodes; TIFF has a decoder of its own, loaded when one comes.

import type { Picture } from 'tessera-wasm';
import { readHeader } from './picture-header';

const kMaxPixels = 100_000_000;

/** A message that the page shows as it is. */
export class PictureError extends Error {}

export async function decode(blob: Blob, name: string): Promise<Picture> {
  const bytes = new Uint8Array(await blob.arrayBuffer());
  if (bytes.length === 0) throw new PictureError(`“${name}” is empty. Choose another file.`);
  const header = readHeader(bytes);
  if (!header) {
    throw new PictureError(`“${name}” is not a picture that can be read. Use PNG, JPEG, WebP, BMP, GIF or TIFF.`);
  }
  refuseTooLarge(name, header.width, header.height);
  try {
    return header.kind === 'TIFF' ? await decodeTiff(bytes, name) : await decodeByBrowser(blob, name);
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

async function decodeByBrowser(blob: Blob, name: string): Promise<Picture> {
  const bitmap = await createImageBitmap(blob, { imageOrientation: 'from-image', colorSpaceConversion: 'none' });
  const { width, height } = bitmap;
  refuseTooLarge(name, width, height);
  const pixels = overWhite(bitmap, width, height);
  bitmap.close();
  return pixels;
}

async function decodeTiff(bytes: Uint8Array, name: string): Promise<Picture> {
  const { decode: readDirectories, decodeImage, toRGBA8 } = await import('utif2');
  const buffer = bytes.slice().buffer;
  const first = readDirectories(buffer)[0];
  if (!first) throw new PictureError(`“${name}” holds no picture.`);
  refuseTooLarge(name, Number(first['t256']), Number(first['t257']));
  decodeImage(buffer, first);
  const { width, height } = first;
  const data = toRGBA8(first);
  if (!(width > 0 && height > 0) || data.length !== 4 * width * height) throw new Error('damaged');
  return { data, width, height };
}

function overWhite(source: CanvasImageSource, width: number, height: number): Picture {
  const context = new OffscreenCanvas(width, height).getContext('2d', { alpha: false, willReadFrequently: true });
  if (!context) throw new PictureError(`There is not enough memory for a picture of ${width} × ${height} pixels.`);
  context.fillStyle = '#fff';
  context.fillRect(0, 0, width, height);
  context.imageSmoothingQuality = 'high';
  context.drawImage(source, 0, 0, width, height);
  return { data: context.getImageData(0, 0, width, height).data, width, height };
}

/** A bitmap to look at, no larger than a screen can show. */
export function bitmapOf(picture: Picture): Promise<ImageBitmap> {
  const { data, width, height } = picture;
  const part = Math.min(1, 4096 / Math.max(width, height));
  const image = new ImageData(new Uint8ClampedArray(data.buffer as ArrayBuffer, data.byteOffset), width, height);
  return createImageBitmap(image, {
    resizeWidth: Math.max(1, Math.round(width * part)),
    resizeHeight: Math.max(1, Math.round(height * part)),
    resizeQuality: 'high',
  });
}

export async function scaled(picture: Picture, scale: number): Promise<Picture> {
  const { data, width, height } = picture;
  const image = new ImageData(new Uint8ClampedArray(data.buffer as ArrayBuffer, data.byteOffset), width, height);
  const bitmap = await createImageBitmap(image);
  const pixels = overWhite(bitmap, Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale)));
  bitmap.close();
  return pixels;
}
