// The sheet that the brush draws on. Each stroke becomes stones as soon as it is drawn.

import { signal } from '@preact/signals';
import { usePicture } from './pictures';
import { drawStroke, type Stroke } from './strokes';
import { tool } from './store';

export const kSheet = { width: 1200, height: 800 };
export const kBrushes = [
  { title: 'Thin brush', width: 14 },
  { title: 'Medium brush', width: 36 },
  { title: 'Broad brush', width: 84 },
] as const;

export const strokes = signal<readonly Stroke[]>([]);
export const brush = signal<number>(kBrushes[1].width);
export const erasing = signal(false);

async function useSheet(): Promise<void> {
  const canvas = new OffscreenCanvas(kSheet.width, kSheet.height);
  const context = canvas.getContext('2d', { alpha: false });
  if (!context) return;
  context.fillStyle = '#fff';
  context.fillRect(0, 0, kSheet.width, kSheet.height);
  for (const stroke of strokes.value) drawStroke(context, stroke);
  await usePicture(await canvas.convertToBlob(), 'drawing.png');
}

function setStrokes(next: readonly Stroke[]): void {
  strokes.value = next;
  void useSheet();
}

/** With the sheet as it was left, or an empty one. */
export function startSketch(): void {
  tool.value = 'sketch';
  void useSheet();
}

export const addStroke = (stroke: Stroke) => setStrokes([...strokes.value, stroke]);
export const undoStroke = () => strokes.value.length > 0 && setStrokes(strokes.value.slice(0, -1));
export const clearSheet = () => strokes.value.length > 0 && setStrokes([]);
