// A word as a drawing: black letters on white, in the heaviest font that the system has.

import { usePicture } from './pictures';

const kFonts = '"Arial Black", "Helvetica Neue", "Segoe UI", Roboto, system-ui, "DejaVu Sans", sans-serif';
const kWidth = 1400; // px, the longest word's
const kTallest = 560; // px, of the letters

export async function useWord(text: string): Promise<void> {
  const word = text.trim();
  if (!word) return;
  const blob = await drawWord(word);
  if (blob) await usePicture(blob, `${word.replace(/[^\p{L}\p{N}]+/gu, '-').slice(0, 40) || 'word'}.png`);
}

async function drawWord(word: string): Promise<Blob | null> {
  const canvas = new OffscreenCanvas(1, 1);
  const context = canvas.getContext('2d', { alpha: false });
  if (!context) return null;
  const fontOf = (size: number) => `900 ${size}px ${kFonts}`;
  context.font = fontOf(100);
  const size = Math.min(kTallest, (100 * kWidth) / Math.max(1, context.measureText(word).width));
  context.font = fontOf(size);
  const measure = context.measureText(word);
  const margin = Math.round(size * 0.22 + 24);
  const ascent = measure.actualBoundingBoxAscent;
  const height = ascent + measure.actualBoundingBoxDescent;
  canvas.width = Math.ceil(measure.width + 2 * margin);
  canvas.height = Math.ceil(height + 2 * margin);
  context.fillStyle = '#fff';
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.font = fontOf(size); // forgotten with the size
  context.fillStyle = '#000';
  context.fillText(word, margin, margin + ascent);
  return canvas.convertToBlob();
}
