// The edges of the target that a morphed grid follows, to look at.

import { kFineEdge, kLargeEdge, type LiveGrid } from 'tessera-wasm';

type Edges = ReturnType<LiveGrid['edges']>;

const kInks: readonly (readonly [number, number, number, number])[] = [
  [120, 120, 120, 110], // does not count
  [225, 40, 20, 255], // large
  [20, 70, 235, 255], // fine
  [170, 30, 170, 255], // both
];

export function paintEdges({ width, height, found, counting }: Edges): ImageBitmap {
  const canvas = new OffscreenCanvas(width, height);
  const image = new ImageData(width, height);
  for (let i = 0; i < width * height; ++i)
    if (found[i]) image.data.set(kInks[counting[i]! & (kLargeEdge | kFineEdge)]!, 4 * i);
  canvas.getContext('2d')?.putImageData(image, 0, 0);
  return canvas.transferToImageBitmap();
}
