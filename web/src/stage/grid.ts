// Finds the piece under a point: buckets of equal squares, each with the pieces whose bounds reach into it.

import type { Pieces } from '../worker/pieces';

export interface Grid {
  cell: number; // px of the picture
  columns: number;
  rows: number;
  /** Bucket b holds members[starts[b]] to members[starts[b + 1]]. */
  starts: Uint32Array;
  members: Uint32Array;
}

/** About two pieces a bucket. */
export function gridOf(pieces: Pieces): Grid {
  const { width, height, count } = pieces;
  const cell = Math.max(1, Math.sqrt((2 * width * height) / Math.max(1, count)));
  const columns = Math.max(1, Math.ceil(width / cell));
  const rows = Math.max(1, Math.ceil(height / cell));
  const grid = { cell, columns, rows, starts: new Uint32Array(columns * rows + 1), members: new Uint32Array(0) };
  eachBucket(pieces, grid, (bucket) => ++grid.starts[bucket + 1]!);
  for (let b = 0; b < columns * rows; ++b) grid.starts[b + 1]! += grid.starts[b]!;
  grid.members = new Uint32Array(grid.starts[columns * rows]!);
  const next = grid.starts.slice();
  eachBucket(pieces, grid, (bucket, piece) => (grid.members[next[bucket]!++] = piece));
  return grid;
}

function eachBucket(pieces: Pieces, grid: Grid, visit: (bucket: number, piece: number) => void): void {
  for (let piece = 0; piece < pieces.count; ++piece) {
    const [left, top, right, bottom] = boundsOf(pieces, piece);
    for (let r = rowOf(grid, top); r <= rowOf(grid, bottom); ++r) {
      for (let c = columnOf(grid, left); c <= columnOf(grid, right); ++c) visit(r * grid.columns + c, piece);
    }
  }
}

export function boundsOf(pieces: Pieces, piece: number): [number, number, number, number] {
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  const [begin, end] = pointsOf(pieces, piece);
  for (let k = begin; k < end; ++k) {
    const x = pieces.points[2 * k]!;
    const y = pieces.points[2 * k + 1]!;
    left = Math.min(left, x);
    right = Math.max(right, x);
    top = Math.min(top, y);
    bottom = Math.max(bottom, y);
  }
  return [left, top, right, bottom];
}

const pointsOf = (pieces: Pieces, piece: number): [number, number] => [
  pieces.ringStarts[pieces.pieceStarts[piece]!]!,
  pieces.ringStarts[pieces.pieceStarts[piece + 1]!]!,
];

/** What sticks out of the picture is in the buckets along its sides. */
const columnOf = ({ cell, columns }: Grid, x: number) => Math.min(columns - 1, Math.max(0, Math.floor(x / cell)));
const rowOf = ({ cell, rows }: Grid, y: number) => Math.min(rows - 1, Math.max(0, Math.floor(y / cell)));

/** The piece at a point of the picture, or -1: grout, or outside. */
export function pieceAt(pieces: Pieces, grid: Grid, x: number, y: number): number {
  const bucket = rowOf(grid, y) * grid.columns + columnOf(grid, x);
  for (let k = grid.starts[bucket]!; k < grid.starts[bucket + 1]!; ++k) {
    const piece = grid.members[k]!;
    if (contains(pieces, piece, x, y)) return piece;
  }
  return -1;
}

/** Even-odd over all rings, so that holes are outside. */
function contains(pieces: Pieces, piece: number, x: number, y: number): boolean {
  let inside = false;
  for (let ring = pieces.pieceStarts[piece]!; ring < pieces.pieceStarts[piece + 1]!; ++ring) {
    const begin = pieces.ringStarts[ring]!;
    const end = pieces.ringStarts[ring + 1]!;
    for (let k = begin, j = end - 1; k < end; j = k++) {
      const [ax, ay] = [pieces.points[2 * j]!, pieces.points[2 * j + 1]!];
      const [bx, by] = [pieces.points[2 * k]!, pieces.points[2 * k + 1]!];
      if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
    }
  }
  return inside;
}
