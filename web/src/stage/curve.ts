// Smooth curves through points, for guides drawn by hand.

import type { Point } from './view';

/** Fewer points, such that the line through them is nowhere further than `tolerance` from those left out. */
export function simplified(points: readonly Point[], tolerance: number): Point[] {
  const first = points[0];
  const last = points.at(-1);
  if (!first || !last || points.length < 3) return [...points];
  let farthest = 0;
  let most = tolerance;
  for (let i = 1; i + 1 < points.length; ++i) {
    const distance = distanceToSegment(points[i]!, first, last);
    if (distance > most) [farthest, most] = [i, distance];
  }
  if (farthest === 0) return [first, last];
  const before = simplified(points.slice(0, farthest + 1), tolerance);
  return [...before.slice(0, -1), ...simplified(points.slice(farthest), tolerance)];
}

function distanceToSegment(p: Point, a: Point, b: Point): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const square = dx * dx + dy * dy;
  const t = square > 0 ? Math.min(1, Math.max(0, ((p.x - a.x) * dx + (p.y - a.y) * dy) / square)) : 0;
  return Math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/** The curve through the points as an SVG path, a Bézier between each two: Catmull and Rom's. */
export function smoothPath(points: readonly Point[]): string {
  const [first, ...others] = points;
  if (!first) return '';
  const words = [`M${at(first)}`];
  if (others.length === 0) words.push(`L${at(first)}`);
  others.forEach((to, i) => {
    const from = points[i]!;
    const before = points[i - 1] ?? from;
    const after = points[i + 2] ?? to;
    const leave = { x: from.x + (to.x - before.x) / 6, y: from.y + (to.y - before.y) / 6 };
    const arrive = { x: to.x - (after.x - from.x) / 6, y: to.y - (after.y - from.y) / 6 };
    words.push(`C${at(leave)} ${at(arrive)} ${at(to)}`);
  });
  return words.join('');
}

const at = ({ x, y }: Point) => `${Number(x.toFixed(2))} ${Number(y.toFixed(2))}`;
