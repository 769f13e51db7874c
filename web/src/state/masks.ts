// Where on the panels there is wood, and where their marks are: what the engine finds, and what people correct in it
// with a brush and by clicks. Strokes belong to the panel's file and are undone with everything else; marks that were
// confirmed are said by the parameter "panels". Places are pixels of the scan.

import { signal } from '@preact/signals';
import type { ParameterValue } from 'tessera-wasm';
import type { Point } from '../stage/view';
import { kMask, kPanel, maskFileOf } from '../worker/protocol';
import type { PanelFile } from './drawn';
import { client } from './page';
import { drawStroke, type Stroke } from './strokes';
import { readMasks, type FoundMask } from './wood-found';

export const kOwnMask = 'own-mask-'; // slot of a mask as its file is
export const kWoodColour = '#ffffff';
export const kNoWoodColour = '#000000';

export interface Found extends FoundMask {
  /** White where there is no wood, else clear. */
  address: string;
}

interface Entry {
  mask: Blob | undefined;
  dpi: string;
  found: Found;
}

const known = signal<ReadonlyMap<Blob, Entry>>(new Map()); // by the scan

const entryOf = (panel: PanelFile, dpi: string): Entry | undefined => {
  const entry = known.value.get(panel.blob);
  return entry?.mask === panel.mask?.blob && entry?.dpi === dpi ? entry : undefined;
};

/** What was found on the panel, as far as it has been looked at. */
export const foundOn = (panel: PanelFile, dpi: string): Found | undefined => entryOf(panel, dpi)?.found;

/** Asks the engine, which has its pictures. What is wrong with them the run will say. */
export async function lookAt(panel: PanelFile, dpi: string): Promise<void> {
  if (entryOf(panel, dpi)) return;
  const { name, mask } = panel;
  const params: Record<string, ParameterValue> = dpi ? { panels: `${name} dpi=${dpi}` } : {};
  const text = await client.answerTo('masks', {
    job: { schemaVersion: 1, technique: 'parquetry', seed: 1, params, inputs: {} },
    inputs: { [kPanel + name]: kPanel + name, ...(mask && { [kMask + name]: kOwnMask + name }) },
  });
  const [found] = text === null ? [] : readMasks(text);
  if (!found) return;
  const address = URL.createObjectURL(await canvasOf(found, kWoodColour, false).convertToBlob());
  const old = known.value.get(panel.blob);
  if (old) URL.revokeObjectURL(old.found.address);
  known.value = new Map(known.value).set(panel.blob, { mask: mask?.blob, dpi, found: { ...found, address } });
}

/** A picture of a mask: `colour` where `wood` is the case, else clear. */
function canvasOf({ width, height, wood: runs }: FoundMask, colour: string, wood: boolean): OffscreenCanvas {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  if (!context) throw new Error(`There is not enough memory for a mask of ${width} × ${height} pixels.`);
  context.fillStyle = colour;
  let at = 0;
  runs.forEach((length, i) => {
    if ((i % 2 === 1) === wood)
      for (let end = at + length, from = at; from < end;) {
        const x = from % width;
        const run = Math.min(width - x, end - from);
        context.fillRect(x, Math.floor(from / width), run, 1);
        from += run;
      }
    at += length;
  });
  return canvas;
}

const made = new WeakMap<readonly Stroke[], { of: Found; blob: Blob }>();

/** The mask for a run: what was found with the strokes over it, or the file as it is; null: it is to be found. */
export async function maskOf(panel: PanelFile, dpi: string, width: number): Promise<PanelFile['mask']> {
  const found = foundOn(panel, dpi);
  if (!panel.strokes.length || !found) return panel.mask;
  let entry = made.get(panel.strokes);
  if (entry?.of !== found) {
    const canvas = new OffscreenCanvas(found.width, found.height);
    const context = canvas.getContext('2d', { alpha: false });
    if (!context) throw new Error('There is not enough memory for a mask.');
    context.drawImage(canvasOf(found, kWoodColour, true), 0, 0);
    context.scale(found.width / width, found.width / width);
    for (const stroke of panel.strokes) drawStroke(context, stroke);
    entry = { of: found, blob: await canvas.convertToBlob() };
    made.set(panel.strokes, entry);
  }
  return { file: maskFileOf(panel.name), blob: entry.blob };
}

/** The marks with one more at a place, or without the one that is there. */
export function toggledMark(marks: readonly Point[], at: Point, reach: number): Point[] {
  const others = marks.filter(({ x, y }) => Math.hypot(x - at.x, y - at.y) > reach);
  return others.length < marks.length ? others : [...marks, at];
}
