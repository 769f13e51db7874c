// Strokes of a brush, on a sheet or over a picture.

import type { Point } from '../stage/view';

export interface Ink {
  width: number; // px of what is drawn on
  colour: string;
}

export interface Stroke extends Ink {
  points: readonly Point[];
}

export type Context2D = CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;

export function drawStroke(context: Context2D, { width, colour, points }: Stroke): void {
  const [first, ...others] = points;
  if (!first) return;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineCap = context.lineJoin = 'round';
  context.beginPath();
  context.moveTo(first.x, first.y);
  context.lineTo(first.x, first.y); // a dot is a stroke, too
  for (const { x, y } of others) context.lineTo(x, y);
  context.stroke();
}
