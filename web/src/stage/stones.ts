// Draws pieces, crisp at every zoom: a path for each colour of each square region, made when first seen.

import type { Pieces } from '../worker/pieces';
import type { EngineToPainter } from '../worker/protocol';
import { boundsOf } from './grid';
import { toPicture, type Size, type View } from './view';

export type Context = OffscreenCanvasRenderingContext2D;

interface Region {
  members: number[];
  left: number;
  top: number;
  right: number;
  bottom: number;
  paths: Map<number, Path2D> | null; // by colour
  lines: Path2D | null; // all in one
}

const kPiecesPerRegion = 400;
const kCovered = 0.999; // of a sheet without grout
const kOverlap = 1; // device px that such pieces are drawn wider, so that nothing shines through where they meet
/** Of a seamless sheet: itself, then its copies on all sides. */
const kAround = [
  [0, 0],
  [-1, -1],
  [0, -1],
  [1, -1],
  [-1, 0],
  [1, 0],
  [-1, 1],
  [0, 1],
  [1, 1],
] as const;
/** Widths in CSS px and inks of a line that is seen on any picture, from below. */
const kLine = [
  [3.4, 'rgb(20 20 20 / 0.75)'],
  [1.5, '#ffd640'],
] as const;

export class StoneDrawing {
  readonly pieces: Pieces;
  /** Of the picture the pieces were made from, as a part of the one on the stage. */
  readonly scale: number;
  /** Where else pieces are seen, px to shift them by: themselves, and on a seamless sheet all around it. */
  readonly around: readonly (readonly [number, number])[];
  private readonly ground: string;
  private readonly face: ImageBitmap | null;
  private readonly covered: boolean;
  private readonly regions: Region[] = [];

  constructor({ pieces, scale, seamless, ground, face }: Omit<EngineToPainter & { type: 'pieces' }, 'type' | 'id'>) {
    const { width, height, count } = pieces;
    this.pieces = pieces;
    this.scale = scale;
    this.around = seamless ? kAround.map(([i, j]) => [i * width, j * height]) : [[0, 0]];
    this.ground = ground;
    this.face = face;
    this.covered = pieces.areas.reduce((sum, area) => sum + area, 0) > kCovered * width * height;
    const side = Math.sqrt((width * height * kPiecesPerRegion) / Math.max(1, count));
    const columns = Math.max(1, Math.ceil(width / side));
    const byPlace = new Map<number, Region>();
    for (let piece = 0; piece < count; ++piece) {
      const [left, top, right, bottom] = boundsOf(pieces, piece);
      const place = Math.floor((top + bottom) / 2 / side) * columns + Math.floor((left + right) / 2 / side);
      const region = byPlace.get(place) ?? { members: [], left, top, right, bottom, paths: null, lines: null };
      region.members.push(piece);
      region.left = Math.min(region.left, left);
      region.top = Math.min(region.top, top);
      region.right = Math.max(region.right, right);
      region.bottom = Math.max(region.bottom, bottom);
      byPlace.set(place, region);
    }
    this.regions = [...byPlace.values()];
  }

  draw(context: Context, view: View, stage: Size, ratio: number): void {
    context.save();
    this.enter(context, view, ratio);
    context.fillStyle = this.ground;
    context.fillRect(0, 0, this.pieces.width, this.pieces.height);
    if (this.face) context.drawImage(this.face, 0, 0, this.pieces.width, this.pieces.height);
    else this.paint(context, view, stage, ratio);
    context.restore();
  }

  private paint(context: Context, view: View, stage: Size, ratio: number): void {
    context.lineWidth = (kOverlap * this.scale) / (ratio * view.scale);
    context.lineJoin = 'round';
    if (this.covered) {
      this.eachPath(context, view, stage, (path, colour) => {
        context.strokeStyle = colour;
        context.stroke(path);
      });
    }
    this.eachPath(context, view, stage, (path, colour) => {
      context.fillStyle = colour;
      context.fill(path);
    });
  }

  private eachPath(context: Context, view: View, stage: Size, draw: (path: Path2D, colour: string) => void): void {
    this.eachSeen(context, view, stage, (region) => {
      region.paths ??= this.pathsOf(region);
      for (const [colour, path] of region.paths) draw(path, this.pieces.palette[colour] ?? '#000');
    });
  }

  /** The outlines of all pieces. */
  outlines(context: Context, view: View, stage: Size, ratio: number): void {
    context.save();
    this.enter(context, view, ratio);
    context.lineJoin = 'round';
    for (const [width, ink] of kLine) {
      context.lineWidth = (width * this.scale) / view.scale;
      context.strokeStyle = ink;
      this.eachSeen(context, view, stage, (region) => context.stroke((region.lines ??= this.linesOf(region))));
    }
    context.restore();
  }

  /** Visits what is seen of the sheet, wherever it is seen, with the context where it is drawn. */
  private eachSeen(context: Context, view: View, stage: Size, visit: (region: Region) => void): void {
    const { scale, pieces } = this;
    const from = toPicture(view, { x: 0, y: 0 });
    const to = toPicture(view, { x: stage.width, y: stage.height });
    const [left, right] = [Math.max(0, from.x * scale), Math.min(pieces.width, to.x * scale)];
    const [top, bottom] = [Math.max(0, from.y * scale), Math.min(pieces.height, to.y * scale)];
    for (const [dx, dy] of this.around) {
      context.translate(dx, dy);
      for (const region of this.regions) {
        if (region.right + dx < left || region.left + dx > right) continue;
        if (region.bottom + dy < top || region.top + dy > bottom) continue;
        visit(region);
      }
      context.translate(-dx, -dy);
    }
  }

  outline(context: Context, view: View, ratio: number, piece: number, ink: string): void {
    const path = new Path2D();
    this.trace(path, piece);
    context.save();
    this.enter(context, view, ratio);
    context.lineJoin = 'round';
    context.strokeStyle = context.fillStyle = ink;
    context.lineWidth = (2.5 * this.scale) / view.scale;
    for (const [dx, dy] of this.around) {
      context.translate(dx, dy);
      context.globalAlpha = 1;
      context.stroke(path);
      context.globalAlpha = 0.28;
      context.fill(path);
      context.translate(-dx, -dy);
    }
    context.restore();
  }

  /** Of the sheet, px of the picture on the stage. */
  get size(): Size {
    return { width: this.pieces.width / this.scale, height: this.pieces.height / this.scale };
  }

  /** Gives back what it holds, and is not drawn any more. */
  close(): void {
    this.face?.close();
  }

  private enter(context: Context, view: View, ratio: number): void {
    const scale = (ratio * view.scale) / this.scale;
    context.setTransform(scale, 0, 0, scale, ratio * view.x, ratio * view.y);
  }

  private pathsOf(region: Region): Map<number, Path2D> {
    const paths = new Map<number, Path2D>();
    for (const piece of region.members) {
      const colour = this.pieces.colours[piece]!;
      const path = paths.get(colour) ?? new Path2D();
      this.trace(path, piece);
      paths.set(colour, path);
    }
    return paths;
  }

  private linesOf(region: Region): Path2D {
    const path = new Path2D();
    for (const piece of region.members) this.trace(path, piece);
    return path;
  }

  /** Outer rings one way around and holes the other, so that pieces of one path may overlap. */
  private trace(path: Path2D, piece: number): void {
    const { pieceStarts, ringStarts, points } = this.pieces;
    for (let ring = pieceStarts[piece]!; ring < pieceStarts[piece + 1]!; ++ring) {
      const [begin, end] = [ringStarts[ring]!, ringStarts[ring + 1]!];
      const hole = ring > pieceStarts[piece]!;
      const forth = windsForth(points, begin, end) !== hole;
      for (let k = 0; k < end - begin; ++k) {
        const at = 2 * (forth ? begin + k : end - 1 - k);
        if (k === 0) path.moveTo(points[at]!, points[at + 1]!);
        else path.lineTo(points[at]!, points[at + 1]!);
      }
      path.closePath();
    }
  }
}

/** Whether the ring of points has a positive area. */
function windsForth(points: Float32Array, begin: number, end: number): boolean {
  let area = 0;
  for (let k = begin, j = end - 1; k < end; j = k++)
    area += points[2 * j]! * points[2 * k + 1]! - points[2 * k]! * points[2 * j + 1]!;
  return area > 0;
}
