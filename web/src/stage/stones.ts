// Draws pieces, crisp at every zoom: a path for each colour of each square region, made when first seen.

import type { Pieces } from '../worker/pieces';
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
/** Widths in CSS px and inks of a line that is seen on any picture, from below. */
const kLine = [
  [3.4, 'rgb(20 20 20 / 0.75)'],
  [1.5, '#ffd640'],
] as const;

export class StoneDrawing {
  private readonly regions: Region[] = [];

  /** `scale`: that of the picture the pieces were made from, as a part of the one on the stage. */
  constructor(
    readonly pieces: Pieces,
    readonly ground: string,
    readonly scale: number,
  ) {
    const { width, height, count } = pieces;
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
    for (const region of this.seen(view, stage)) {
      region.paths ??= this.pathsOf(region);
      for (const [colour, path] of region.paths) {
        context.fillStyle = this.pieces.palette[colour] ?? '#000';
        context.fill(path, 'evenodd');
      }
    }
    context.restore();
  }

  /** The outlines of all pieces. */
  outlines(context: Context, view: View, stage: Size, ratio: number): void {
    context.save();
    this.enter(context, view, ratio);
    context.lineJoin = 'round';
    for (const [width, ink] of kLine) {
      context.lineWidth = (width * this.scale) / view.scale;
      context.strokeStyle = ink;
      for (const region of this.seen(view, stage)) context.stroke((region.lines ??= this.linesOf(region)));
    }
    context.restore();
  }

  private *seen(view: View, stage: Size): Generator<Region> {
    const { scale } = this;
    const from = toPicture(view, { x: 0, y: 0 });
    const to = toPicture(view, { x: stage.width, y: stage.height });
    for (const region of this.regions) {
      if (region.right < from.x * scale || region.left > to.x * scale) continue;
      if (region.bottom < from.y * scale || region.top > to.y * scale) continue;
      yield region;
    }
  }

  outline(context: Context, view: View, ratio: number, piece: number, ink: string): void {
    const path = new Path2D();
    this.trace(path, piece);
    context.save();
    this.enter(context, view, ratio);
    context.lineJoin = 'round';
    context.strokeStyle = ink;
    context.lineWidth = (2.5 * this.scale) / view.scale;
    context.stroke(path);
    context.globalAlpha = 0.28;
    context.fillStyle = ink;
    context.fill(path, 'evenodd');
    context.restore();
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

  private trace(path: Path2D, piece: number): void {
    const { pieceStarts, ringStarts, points } = this.pieces;
    for (let ring = pieceStarts[piece]!; ring < pieceStarts[piece + 1]!; ++ring) {
      const begin = ringStarts[ring]!;
      path.moveTo(points[2 * begin]!, points[2 * begin + 1]!);
      for (let k = begin + 1; k < ringStarts[ring + 1]!; ++k) path.lineTo(points[2 * k]!, points[2 * k + 1]!);
      path.closePath();
    }
  }
}
