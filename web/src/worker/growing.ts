// A parquetry while it grows: what the engine says of the pieces it has laid, drawn from the scans they come from.

import type { Picture } from 'tessera-wasm';
import type { WoodPiece } from './protocol';

const kInchMm = 25.4;
const kFinestDpi = 150; // of matching, and
const kUnknownDpi = 300; // of a scan of which nobody says it; both as in core/parquetry/panels.cpp
const kMaxSide = 1400; // px of the growing picture
const kNumbers = 19;

export interface Laid {
  /** Which target, or copy of it, counted from 0. */
  target: number;
  row: number;
  column: number;
  level: number;
  /** px of the target at the panels' resolution. */
  x: number;
  y: number;
  width: number;
  height: number;
  /** Index of the panels in the order of their names; -1: no wood was left. */
  panel: number;
  cost: number;
  /** Degrees clockwise from the panel to the target. */
  turn: number;
  /** The box's middle, and where that comes from on the panel. */
  from: readonly [number, number];
  to: readonly [number, number];
}

/** The lines of a state, as core/parquetry/state.cpp writes them, from one on. */
export function readLaid(state: string, begin: number): Laid[] {
  return state
    .split('\n')
    .slice(2 + begin, -1)
    .map((line) => line.split(' ').map(Number))
    .filter((n) => n.length === kNumbers)
    .map((n) => ({
      target: n[0]!,
      row: n[1]!,
      column: n[2]!,
      level: n[4]!,
      x: n[5]!,
      y: n[6]!,
      width: n[7]!,
      height: n[8]!,
      panel: n[9]!,
      cost: n[13]!,
      turn: n[14]!,
      from: [n[15]!, n[16]!],
      to: [n[17]!, n[18]!],
    }));
}

/** "C12" of row 11 and column 2, counted from 0; quarters have no letter of their own yet. */
export function nameOf(row: number, column: number): string {
  let letters = '';
  for (let n = column + 1; n > 0; n = Math.floor((n - 1) / 26))
    letters = String.fromCharCode(65 + ((n - 1) % 26)) + letters;
  return `${letters}${row + 1}`;
}

/** The corners of the box where it is cut: turned back about its middle. */
export function cornersOnPanel({ x, y, width, height, from, to, turn }: Laid): number[] {
  const angle = (turn * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [
    [x, y],
    [x + width, y],
    [x + width, y + height],
    [x, y + height],
  ].flatMap(([px, py]) => {
    const [dx, dy] = [px! - from[0], py! - from[1]];
    return [to[0] + c * dx + s * dy, to[1] - s * dx + c * dy];
  });
}

export interface GrowingPanel {
  name: string;
  dpi: number;
  picture: Picture;
}

/** The resolution at which panels are matched. */
export function matchingDpi(panels: readonly { dpi: number }[], wanted: number): number {
  if (wanted > 0) return wanted;
  return Math.min(kFinestDpi, ...panels.map(({ dpi }) => dpi || kUnknownDpi));
}

interface Size {
  width: number;
  height: number;
}

export class Growing {
  private readonly canvas: OffscreenCanvas;
  private readonly panels: { name: string; scan: OffscreenCanvas; perScan: number }[];
  private readonly dpi: number;
  private readonly scale: number;
  private readonly lefts: number[] = []; // of targets, px
  private seen = 0;

  /** `panels` in the order of their names; `targets`: their sizes, `sizeMm` their shorter sides. */
  constructor(panels: readonly GrowingPanel[], targets: readonly Size[], sizeMm: number, dpi: number, copies = 1) {
    this.dpi = matchingDpi(panels, dpi);
    let width = 0;
    let height = 0;
    for (let copy = 0; copy < copies; ++copy)
      for (const target of targets) {
        const perPx = ((sizeMm / kInchMm) * this.dpi) / Math.min(target.width, target.height);
        this.lefts.push(width);
        width += Math.round(target.width * perPx);
        height = Math.max(height, target.height * perPx);
      }
    this.scale = Math.min(1, kMaxSide / Math.max(width, height));
    this.canvas = new OffscreenCanvas(
      Math.max(1, Math.round(width * this.scale)),
      Math.max(1, Math.round(height * this.scale)),
    );
    this.panels = panels.map(({ name, dpi: own, picture }) => ({
      name,
      scan: canvasOf(picture),
      perScan: (own || kUnknownDpi) / this.dpi,
    }));
  }

  /** Draws what is new in a state; the answer is that, for the page. */
  take(state: string): WoodPiece[] {
    const laid = readLaid(state, this.seen);
    this.seen += laid.length;
    const context = this.canvas.getContext('2d');
    const mm = kInchMm / this.dpi;
    return laid.flatMap((one) => {
      const panel = this.panels[one.panel];
      if (!panel || !context) return [];
      this.draw(context, panel, one);
      return {
        id: (this.lefts.length > 1 ? `${one.target + 1}-` : '') + nameOf(one.row, one.column),
        row: one.row + 1,
        column: one.column + 1,
        panel: panel.name,
        onPanel: cornersOnPanel(one).map((px) => px * mm),
        turn: one.turn,
        cost: one.cost,
      };
    });
  }

  private draw(
    context: OffscreenCanvasRenderingContext2D,
    { scan, perScan }: { scan: OffscreenCanvas; perScan: number },
    { target, x, y, width, height, from, to, turn }: Laid,
  ): void {
    const reach = Math.hypot(width, height) / 2 + 1;
    context.save();
    context.scale(this.scale, this.scale);
    context.translate(this.lefts[target] ?? 0, 0); // side by side
    context.beginPath();
    context.rect(x, y, width, height);
    context.clip();
    context.translate(from[0], from[1]);
    context.rotate((turn * Math.PI) / 180);
    const side = 2 * reach * perScan;
    context.drawImage(
      scan,
      (to[0] - reach) * perScan,
      (to[1] - reach) * perScan,
      side,
      side,
      -reach,
      -reach,
      2 * reach,
      2 * reach,
    );
    context.restore();
  }

  /** As it is now, to be given away. */
  bitmap(): ImageBitmap {
    const copy = new OffscreenCanvas(this.canvas.width, this.canvas.height);
    copy.getContext('2d')?.drawImage(this.canvas, 0, 0);
    return copy.transferToImageBitmap();
  }
}

function canvasOf({ data, width, height }: Picture): OffscreenCanvas {
  const canvas = new OffscreenCanvas(width, height);
  const pixels = new Uint8ClampedArray(data.buffer as ArrayBuffer, data.byteOffset, data.byteLength);
  canvas.getContext('2d')?.putImageData(new ImageData(pixels, width, height), 0, 0);
  return canvas;
}
