// A preview of the diagram, ready to draw: its cells, its borders, its sites.

import { kCellBorder, kZoneBorder, type Preview } from 'tessera-wasm';
import { borderTable, cellTable, picturedCells, pixelsOf, stampSites, type Rgba } from './preview';
import type { Context } from './stones';
import type { Size, View } from './view';

const kJoint: Rgba = [150, 146, 138, 255];
const kSpacing = 18; // CSS px between strokes of the direction field

export class Diagram {
  private readonly images = new Map<string, OffscreenCanvas>();

  /** `scale`: that of the picture the diagram is of, as a part of the one on the stage, `width` px wide. */
  constructor(
    private readonly preview: Preview,
    private readonly scale: number,
    private readonly width: number,
    /** The picture's pixels in a size. */
    private readonly picture: (width: number, height: number) => Uint8ClampedArray | null,
  ) {}

  /** Over the picture's whole area, which the context's transform has to map to the unit square. */
  cells(context: Context): void {
    this.image(context, 'cells', () => this.cellPixels());
  }

  /** Cells and sites in one, cheap enough for thirty a second. */
  live(context: Context, ink: Rgba): void {
    this.image(context, `live ${ink}`, () => {
      const pixels = this.cellPixels();
      stampSites(pixels, this.preview, this.preview.width / (this.width * this.scale), ink);
      return pixels;
    });
  }

  private cellPixels() {
    const { palette, width, height } = this.preview;
    const picture = palette.length === 3 ? this.picture(width, height) : null; // one zone: it has no colours to tell
    if (picture) return picturedCells(this.preview, picture, kJoint);
    return pixelsOf(this.preview, cellTable(this.preview.palette, kJoint));
  }

  borders(context: Context, of: 'cells' | 'zones', ink: Rgba): void {
    const flag = of === 'cells' ? kCellBorder : kZoneBorder;
    this.image(context, `${of} ${ink}`, () => pixelsOf(this.preview, borderTable(flag, ink)));
  }

  private image(context: Context, key: string, paint: () => Uint8ClampedArray<ArrayBuffer>): void {
    let canvas = this.images.get(key);
    if (!canvas) {
      const { width, height } = this.preview;
      canvas = new OffscreenCanvas(width, height);
      canvas.getContext('2d')?.putImageData(new ImageData(paint(), width, height), 0, 0);
      this.images.set(key, canvas);
    }
    context.drawImage(canvas, 0, 0, 1, 1);
  }

  sites(context: Context, view: View, stage: Size, ratio: number, ink: string): void {
    const side = Math.min(2.4, Math.max(1.2, view.scale * 1.1));
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = ink;
    this.eachSite(view, stage, (x, y) => context.fillRect(x - side / 2, y - side / 2, side, side));
  }

  /** Strokes along the stones' directions, one to a patch of the stage, so that they never crowd. */
  directions(context: Context, view: View, stage: Size, ratio: number, ink: string): void {
    const taken = new Set<number>();
    const columns = Math.ceil(stage.width / kSpacing) + 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.strokeStyle = ink;
    context.lineWidth = 1.4;
    context.lineCap = 'round';
    context.beginPath();
    this.eachSite(view, stage, (x, y, angle) => {
      const patch = Math.floor(y / kSpacing) * columns + Math.floor(x / kSpacing);
      if (taken.has(patch)) return;
      taken.add(patch);
      const dx = Math.cos(angle) * kSpacing * 0.4;
      const dy = Math.sin(angle) * kSpacing * 0.4;
      context.moveTo(x - dx, y - dy);
      context.lineTo(x + dx, y + dy);
    });
    context.stroke();
  }

  private eachSite(view: View, stage: Size, visit: (x: number, y: number, angle: number) => void): void {
    const { sites } = this.preview;
    for (let i = 0; i + 3 < sites.length; i += 4) {
      const x = (sites[i]! / this.scale) * view.scale + view.x;
      const y = (sites[i + 1]! / this.scale) * view.scale + view.y;
      if (x >= 0 && y >= 0 && x <= stage.width && y <= stage.height) visit(x, y, sites[i + 2]!);
    }
  }
}
