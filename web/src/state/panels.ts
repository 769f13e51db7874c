// The panels of wood that a parquetry is cut from: files with names, masks and resolutions. Files are undone with
// everything else, as what is drawn over a picture; what is said of them is the parameter "panels".

import { signal } from '@preact/signals';
import { kMask, kPanel, type PanelScale, type WoodPiece } from '../worker/protocol';
import type { Point } from '../stage/view';
import type { DrawnPicture, PanelFile } from './drawn';
import { changeDrawn, changePanels, endStep } from './edits';
import { foundOn, kOwnMask, lookAt, maskOf } from './masks';
import { client } from './page';
import { onlyOf, panelName, readPanelOptions, renamed, withOption } from './panel-options';
import { alertWith, drawn, edits, entry, params } from './store';
import type { Stroke } from './strokes';
import { readMarks, writeMarks } from './wood-found';

export const kPanels = 'panels'; // the parameter

/** What the engine's worker found in a panel's file. */
interface Seen {
  width: number;
  height: number;
  dpi: number;
  address: string;
}

/** By the file; the address is that of its picture. */
const seen = signal<ReadonlyMap<Blob, Seen>>(new Map());
export const seenOf = ({ blob }: PanelFile): Seen | undefined => seen.value.get(blob);

/** Of the run that goes on: what has been laid, and what the forecast said before. */
export const laid = signal<readonly WoodPiece[]>([]);
export const forecast = signal('');
/** Seconds in which a result is made better once it is there. */
export const improveFor = signal(0);

const options = () => String(params.value[kPanels] ?? '');
export const dpiOf = ({ name }: PanelFile): string => readPanelOptions(options()).get(name)?.['dpi'] ?? '';

/** Those that there are; the technique's own before there are any. */
export const panels = (): readonly PanelFile[] => drawn.value.panels ?? [];
export const panelScales = (): PanelScale[] =>
  panels().map((panel) => ({ name: panel.name, dpi: Number(dpiOf(panel)) }));

/** The parameter for a job: of panels that are there. */
export const ownOptions = () =>
  onlyOf(
    options(),
    panels().map(({ name }) => name),
  );

/** The technique's own panels, where nobody has chosen any. Rejects with a message for people. */
export async function fetchPanels(): Promise<void> {
  const { panels: own } = entry.value;
  if (!own || drawn.value.panels !== null) return;
  const files = await Promise.all(
    own.map(async ({ name, file }): Promise<PanelFile> => {
      const response = await fetch(`samples/panels/${file}`).catch(() => null);
      if (!response?.ok)
        throw new Error(`The panel “${name}” could not be loaded. Check the connection, or use your own.`);
      return { name, file, blob: await response.blob(), mask: null, strokes: [], sample: true };
    }),
  );
  if (drawn.value.panels !== null) return;
  const { present } = edits.value;
  edits.value = { ...edits.value, present: { ...present, drawn: { ...present.drawn, panels: files } } };
}

/** Gives the worker the files of the panels; each once only. */
export async function sendPanels(): Promise<void> {
  for (const panel of panels()) {
    const { name, mask } = panel;
    await send(kPanel + name, panel.file, panel.blob);
    if (mask) await send(kOwnMask + name, mask.file, mask.blob);
    await lookAt(panel, dpiOf(panel));
    const corrected = await correctedMask(panel);
    if (corrected) await send(kMask + name, corrected.file, corrected.blob);
  }
}

const correctedMask = (panel: PanelFile) => maskOf(panel, dpiOf(panel), seenOf(panel)?.width ?? 1);

const sent = new Map<string, Blob>(); // by slot

async function send(slot: string, file: string, blob: Blob): Promise<void> {
  if (sent.get(slot) === blob) return;
  const { width, height, panel } = await client.setPicture(slot, file, blob);
  sent.set(slot, blob);
  if (!panel || seen.value.has(blob)) return;
  seen.value = new Map(seen.value).set(blob, {
    width,
    height,
    dpi: panel.dpi,
    address: URL.createObjectURL(panel.small),
  });
}

/** More panels; the first of one's own take the place of the technique's. */
export async function addPanels(files: readonly File[]): Promise<void> {
  const before = panels().filter(({ sample }) => !sample);
  const added: PanelFile[] = [];
  const refused: string[] = [];
  for (const file of files) {
    const taken = [...before, ...added].map(({ name }) => name);
    const name = panelName(file.name, taken);
    try {
      await send(kPanel + name, file.name, file);
      added.push({ name, file: file.name, blob: file, mask: null, strokes: [], sample: false });
    } catch (error) {
      refused.push(error instanceof Error ? error.message : String(error));
    }
  }
  if (added.length) changeDrawn({ panels: [...before, ...added] });
  endStep();
  if (refused.length) alertWith(...refused);
}

export async function setMask(panel: PanelFile, file: File): Promise<void> {
  try {
    await send(kOwnMask + panel.name, file.name, file);
  } catch (error) {
    return alertWith(error instanceof Error ? error.message : String(error));
  }
  replace(panel, { ...panel, mask: { file: file.name, blob: file }, strokes: [] });
}

export const dropMask = (panel: PanelFile) => replace(panel, { ...panel, mask: null, strokes: [] });

/** One more stroke over the mask; none: all of them go. */
export const correctMask = (panel: PanelFile, stroke: Stroke | null) =>
  replace(panel, { ...panel, strokes: stroke ? [...panel.strokes, stroke] : [] });

export const found = (panel: PanelFile) => foundOn(panel, dpiOf(panel));

/** Those that people have confirmed or set; null: those that are found count. */
export function ownMarks({ name }: PanelFile): Point[] | null {
  const text = readPanelOptions(options()).get(name)?.['marks'];
  return text === undefined ? null : readMarks(text);
}
export const marksOf = (panel: PanelFile): readonly Point[] => ownMarks(panel) ?? found(panel)?.marks ?? [];

/** Null: those that are found count again. */
export function setMarks(panel: PanelFile, marks: readonly Point[] | null): void {
  changePanels(panels(), withOption(options(), panel.name, 'marks', marks ? writeMarks(marks) : ''));
  endStep();
}

/** Sets what is known of it. */
export const setDpi = (panel: PanelFile, dpi: string) =>
  changePanels(panels(), withOption(options(), panel.name, 'dpi', dpi), `dpi ${panel.name}`);

export function rename(panel: PanelFile, name: string): void {
  const others = panels().filter((one) => one !== panel);
  const plain = panelName(
    name,
    others.map((one) => one.name),
  );
  if (plain === panel.name) return;
  const next = panels().map((one) => (one === panel ? { ...panel, name: plain } : one));
  changePanels(next, renamed(options(), panel.name, plain));
  endStep();
}

export function remove(panel: PanelFile): void {
  changePanels(
    panels().filter((one) => one !== panel),
    renamed(options(), panel.name, null),
  );
  endStep();
}

function replace(panel: PanelFile, by: PanelFile): void {
  changeDrawn({ panels: panels().map((one) => (one === panel ? by : one)) });
  endStep();
}

/** As pictures of a job; the engine has them. */
export async function panelPictures(): Promise<DrawnPicture[]> {
  const all = panels().map(async (panel) => {
    const { name, file, blob } = panel;
    const mask = await correctedMask(panel);
    return [
      { role: kPanel + name, name: file, blob },
      ...(mask ? [{ role: kMask + name, name: mask.file, blob: mask.blob }] : []),
    ];
  });
  return (await Promise.all(all)).flat();
}
