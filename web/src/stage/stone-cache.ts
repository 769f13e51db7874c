// Keeps what the stones looked like last, so that a gesture stays fluent where they are too many to draw in time.

import { fit, type Size, type View } from './view';
import type { Context, StoneDrawing } from './stones';

const kFluent = 12; // ms
const kSettled = 90; // ms without a change of the view
// Thousands of small polygons are drawn faster by the processor than by what a graphics card makes of them.
const kBySoftware = { willReadFrequently: true };
const kOverviewSide = 1600;
const kFineLines = 2.5; // device px of a source pixel below which grout is finer than a canvas can draw well

export class StoneCache {
  private readonly canvas = new OffscreenCanvas(1, 1);
  private drawn: { stones: StoneDrawing; view: View; stage: Size; ratio: number } | null = null;
  private cost = 0;
  private viewSince = 0;
  private lastView: View | null = null;
  private overview: { stones: StoneDrawing; canvas: OffscreenCanvas } | null = null;

  /** Draws the stones, or the best that is at hand; true where it has to be called again for the crisp ones. */
  draw(context: Context, stones: StoneDrawing, view: View, stage: Size, ratio: number, now: number): boolean {
    if (!same(view, this.lastView)) [this.lastView, this.viewSince] = [view, now];
    const fresh = this.drawn?.stones !== stones || this.drawn.stage !== stage || this.drawn.ratio !== ratio;
    if (fresh || !same(view, this.drawn?.view ?? null)) {
      if (fresh || this.cost < kFluent || now - this.viewSince > kSettled) this.redraw(stones, view, stage, ratio);
    }
    const { drawn } = this;
    if (!drawn) return false;
    const crisp = same(view, drawn.view);
    context.setTransform(1, 0, 0, 1, 0, 0);
    if (!crisp) this.drawOverview(context, stones, view, ratio);
    const part = view.scale / drawn.view.scale;
    const x = ratio * (view.x - drawn.view.x * part);
    const y = ratio * (view.y - drawn.view.y * part);
    context.drawImage(this.canvas, x, y, this.canvas.width * part, this.canvas.height * part);
    return !crisp;
  }

  private redraw(stones: StoneDrawing, view: View, stage: Size, ratio: number): void {
    const begin = performance.now();
    const width = Math.max(1, Math.round(stage.width * ratio));
    const height = Math.max(1, Math.round(stage.height * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const context = this.canvas.getContext('2d', kBySoftware);
    if (!context) return;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    if (view.scale * ratio < kFineLines) drawFine(context, stones, view, stage, ratio);
    else stones.draw(context, view, stage, ratio);
    this.drawn = { stones, view, stage, ratio };
    this.cost = performance.now() - begin;
  }

  /** The whole sheet, for what a gesture brings into sight. */
  private drawOverview(context: Context, stones: StoneDrawing, view: View, ratio: number): void {
    if (this.overview?.stones !== stones) this.overview = { stones, canvas: overviewOf(stones) };
    const { width, height } = stones.size;
    const side = ratio * view.scale;
    context.drawImage(this.overview.canvas, ratio * view.x, ratio * view.y, width * side, height * side);
  }
}

/** Twice as large, then halved: fewer grey levels would make thin grout look like noise. */
function drawFine(context: Context, stones: StoneDrawing, view: View, stage: Size, ratio: number): void {
  const { width, height } = context.canvas;
  const large = new OffscreenCanvas(2 * width, 2 * height);
  const drawing = large.getContext('2d', kBySoftware);
  if (!drawing) return;
  stones.draw(drawing, view, stage, 2 * ratio);
  context.imageSmoothingQuality = 'low';
  context.drawImage(large, 0, 0, width, height);
}

function overviewOf(stones: StoneDrawing): OffscreenCanvas {
  const { size } = stones;
  const part = Math.min(1, kOverviewSide / Math.max(size.width, size.height));
  const stage = {
    width: Math.max(1, Math.round(size.width * part)),
    height: Math.max(1, Math.round(size.height * part)),
  };
  const canvas = new OffscreenCanvas(stage.width, stage.height);
  const context = canvas.getContext('2d', kBySoftware);
  if (context) stones.draw(context, fit(size, stage, 0), stage, 1);
  return canvas;
}

const same = (a: View, b: View | null) => b !== null && a.scale === b.scale && a.x === b.x && a.y === b.y;
