// Everything there is to see on the stage, and one picture of it.

import type { EngineToPainter, Look, PieceFacts } from '../worker/protocol';
import { Diagram } from './diagram';
import { gridOf, pieceAt, type Grid } from './grid';
import { rgbaOf } from './ink';
import { StoneCache } from './stone-cache';
import { StoneDrawing, type Context } from './stones';
import { toPicture, type Point, type Size, type View } from './view';

const kFade = 260; // ms from the last diagram to the stones

export class Scene {
  view: View = { scale: 1, x: 0, y: 0 };
  stage: Size = { width: 1, height: 1 };
  ratio = 1;
  look: Look | null = null;
  pointer: Point | null = null;
  /** How far pieces reach, px of the picture, where that is farther than itself. */
  extent: Size | null = null;

  private sheet: Size | null = null;
  private compared: ImageBitmap | null = null; // with the sheet, and as large
  private source: { bitmap: ImageBitmap; width: number; height: number } | null = null;
  private stones: { drawing: StoneDrawing; grid: Grid } | null = null;
  private diagram: Diagram | null = null; // that the stones were made from
  private live: { id: number; diagram: Diagram } | null = null;
  private growing: { id: number; bitmap: ImageBitmap } | null = null; // pieces that have been laid so far
  private fading: { diagram: Diagram; since: number } | null = null;
  private small: ImageData | null = null; // see sourcePixels()
  private dropped = 0;
  private readonly cache = new StoneCache();

  /** Whether draw() draws it. */
  get hasPicture(): boolean {
    return Boolean((this.sheet ? this.stones : this.source) && this.look);
  }

  /** What there is to look at, px: the picture, or without one the sheet. */
  private get area(): Size | null {
    if (this.sheet) return this.stones?.drawing.size ?? this.sheet;
    return this.source && (this.extent ?? this.source);
  }

  /** Without a picture from now on, or on one again; a sheet of another size takes its pieces as they come. */
  lay(sheet: Size | null): void {
    if (!sheet !== !this.sheet) this.clear();
    this.sheet = sheet;
  }

  private clear(): void {
    this.stones?.drawing.close();
    this.stones = this.diagram = this.live = this.fading = null;
    this.grow(null);
  }

  take(message: EngineToPainter): void {
    if (message.type === 'source') return this.takeSource(message);
    if (message.type === 'compared') {
      this.compared?.close();
      this.compared = message.bitmap;
      return;
    }
    if (message.id <= this.dropped) return;
    if (message.type === 'growing') return this.grow(message);
    if (message.type === 'preview') {
      const diagram = new Diagram(message.preview, message.scale, this.source?.width ?? 1, (w, h) =>
        this.sourcePixels(w, h),
      );
      this.live = { id: message.id, diagram };
      return;
    }
    this.grow(null);
    const drawing = new StoneDrawing(message);
    this.stones?.drawing.close();
    this.stones = { drawing, grid: gridOf(message.pieces) };
    if (this.live) {
      this.diagram = this.live.diagram;
      this.fading = { diagram: this.diagram, since: performance.now() };
    }
    this.live = null;
  }

  drop(upTo: number): void {
    this.dropped = Math.max(this.dropped, upTo);
    if (this.live && this.live.id <= upTo) this.live = null;
    if (this.growing && this.growing.id <= upTo) this.grow(null);
  }

  private grow(growing: { id: number; bitmap: ImageBitmap } | null): void {
    this.growing?.bitmap.close();
    this.growing = growing;
  }

  /** Stones of a picture of another size do not fit the new one; of the same size, they stay until others come. */
  private takeSource(source: { bitmap: ImageBitmap; width: number; height: number }): void {
    const old = this.source;
    old?.bitmap.close();
    this.source = source;
    this.small = null;
    if (old?.width === source.width && old.height === source.height) return;
    if (!this.sheet) this.clear();
  }

  /** The source over white, in a diagram's size; kept, as a run shows many diagrams of one size. */
  private sourcePixels(width: number, height: number): Uint8ClampedArray | null {
    if (!this.source) return null;
    if (this.small?.width === width && this.small.height === height) return this.small.data;
    const context = new OffscreenCanvas(width, height).getContext('2d', { alpha: false, willReadFrequently: true });
    if (!context) return null;
    context.fillStyle = '#fff';
    context.fillRect(0, 0, width, height);
    context.drawImage(this.source.bitmap, 0, 0, width, height);
    this.small = context.getImageData(0, 0, width, height);
    return this.small.data;
  }

  pieceUnderPointer(): number {
    if (!this.pointer || !this.stones || this.live || this.growing || !this.look) return -1;
    if (!this.look.layers.stones && !this.look.layers.outlines) return -1;
    if (this.pointer.x < this.look.divider * this.stage.width) return -1;
    const { drawing, grid } = this.stones;
    const p = toPicture(this.view, this.pointer);
    for (const [dx, dy] of drawing.around) {
      const piece = pieceAt(drawing.pieces, grid, p.x * drawing.scale - dx, p.y * drawing.scale - dy);
      if (piece >= 0) return piece;
    }
    return -1;
  }

  facts(piece: number): PieceFacts | null {
    if (piece < 0 || !this.stones) return null;
    const { pieces, scale } = this.stones.drawing;
    return {
      kind: pieces.kind,
      id: pieces.ids[piece]!,
      area: pieces.areas[piece]! / scale ** 2,
      vertices: pieces.vertices[piece]!,
      orientation: pieces.orientations[piece]!,
    };
  }

  /** True where another frame is wanted. */
  draw(context: Context, now: number): boolean {
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, context.canvas.width, context.canvas.height);
    if (!this.area || !this.look) return false;
    context.save();
    this.clip(context);
    const again = this.drawBase(context, this.look, now);
    this.drawLayers(context, this.look);
    const piece = this.pieceUnderPointer();
    if (piece >= 0) this.stones?.drawing.outline(context, this.view, this.ratio, piece, this.look.accent);
    context.restore();
    this.drawBefore(context, this.look);
    this.drawFrame(context, this.look);
    return again;
  }

  private drawBase(context: Context, look: Look, now: number): boolean {
    if (this.live) {
      this.overPicture(context, () => this.live?.diagram.live(context, rgbaOf(look.accent)));
      return false;
    }
    const { growing } = this;
    if (growing) {
      this.drawSource(context, 0.35);
      this.overPicture(context, () => context.drawImage(growing.bitmap, 0, 0, 1, 1));
      return false;
    }
    const bare = !this.stones;
    let again = false;
    if (this.stones && look.layers.stones) {
      again = this.cache.draw(context, this.stones.drawing, this.view, this.stage, this.ratio, now);
    } else if (this.diagram && look.layers.cells) {
      this.overPicture(context, () => this.diagram?.cells(context));
    } else if ((bare || look.layers.source) && !this.sheet) {
      this.drawSource(context, bare ? 0.35 : 1);
    } else {
      this.overPicture(context, () => {
        context.fillStyle = '#fbfaf7';
        context.fillRect(0, 0, 1, 1);
      });
    }
    return this.drawFading(context, look, now) || again;
  }

  private drawFading(context: Context, look: Look, now: number): boolean {
    if (!this.fading) return false;
    const left = 1 - (now - this.fading.since) / kFade;
    if (left <= 0 || look.calm || !look.layers.stones) {
      this.fading = null;
      return false;
    }
    context.globalAlpha = Math.min(1, left);
    this.overPicture(context, () => this.fading?.diagram.cells(context));
    context.globalAlpha = 1;
    return true;
  }

  private drawLayers(context: Context, look: Look): void {
    const { layers, accent } = look;
    if (this.live || this.growing) return;
    if (layers.source && layers.stones && this.stones) this.drawSource(context, 0.5);
    const { diagram, view, stage, ratio } = this;
    if (layers.outlines) this.stones?.drawing.outlines(context, view, stage, ratio);
    if (!diagram) return;
    const [r, g, b] = rgbaOf(accent);
    if (layers.cells && layers.stones) {
      this.overPicture(context, () => diagram.borders(context, 'cells', [r, g, b, 200]));
    }
    if (layers.edges) this.overPicture(context, () => diagram.borders(context, 'zones', [214, 64, 36, 255]));
    if (layers.direction) diagram.directions(context, view, stage, ratio, accent);
    if (layers.sites) diagram.sites(context, view, stage, ratio, '#d64024');
  }

  private drawBefore(context: Context, look: Look): void {
    if (look.divider <= 0) return;
    context.save();
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.beginPath();
    context.rect(0, 0, look.divider * this.stage.width, this.stage.height);
    context.clip();
    this.drawSource(context, 1);
    context.restore();
  }

  private drawSource(context: Context, alpha: number): void {
    const bitmap = this.sheet ? this.compared : this.source?.bitmap;
    if (!bitmap) return;
    const { width, height } = this.area ?? { width: 1, height: 1 };
    const own = this.sheet ? this.area : this.source;
    const [across, down] = [(own?.width ?? 1) / width, (own?.height ?? 1) / height];
    this.overPicture(context, () => {
      context.globalAlpha = alpha;
      context.fillStyle = '#fff'; // what is transparent counts as white
      context.fillRect(0, 0, across, down);
      context.drawImage(bitmap, 0, 0, across, down);
    });
  }

  /** A hairline around the picture, which sets white paper off a light stage. */
  private drawFrame(context: Context, look: Look): void {
    if (!this.area) return;
    const { scale, x, y } = this.view;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.strokeStyle = look.line;
    context.lineWidth = 1;
    context.strokeRect(x - 0.5, y - 0.5, this.area.width * scale + 1, this.area.height * scale + 1);
  }

  /** Draws with the picture's area as the unit square. */
  private overPicture(context: Context, draw: () => void): void {
    const { ratio, view, area } = this;
    if (!area) return;
    context.save();
    context.setTransform(
      ratio * view.scale * area.width,
      0,
      0,
      ratio * view.scale * area.height,
      ratio * view.x,
      ratio * view.y,
    );
    context.imageSmoothingEnabled = view.scale < 3;
    context.imageSmoothingQuality = 'medium';
    draw();
    context.restore();
  }

  /** What lies right of the divider, within the picture. */
  private clip(context: Context): void {
    if (!this.area || !this.look) return;
    const { scale, x, y } = this.view;
    const divider = this.look.divider * this.stage.width;
    const left = Math.max(x, divider);
    const right = x + this.area.width * scale;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.beginPath();
    context.rect(left, y, Math.max(0, right - left), this.area.height * scale);
    context.clip();
  }
}
