// The panels of wood that a parquetry is cut from: files with names, masks and resolutions. Files are undone with
// everything else, as what is drawn over a picture; what is said of them is the parameter "panels".

import { signal } from '@preact/signals';
import { kMask, kPanel, type PanelScale, type WoodPiece } from '../worker/protocol';
import type { PanelFile } from './drawn';
import { changeDrawn, changePanels, endStep } from './edits';
import { client } from './page';
import { onlyOf, panelName, readPanelOptions, renamed, withOption } from './panel-options';
import { alertWith, drawn, edits, entry, params } from './store';

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
      return { name, file, blob: await response.blob(), mask: null, sample: true };
    }),
  );
  if (drawn.value.panels !== null) return;
  const { present } = edits.value;
  edits.value = { ...edits.value, present: { ...present, drawn: { ...present.drawn, panels: files } } };
}

/** Gives the worker the files of the panels; each once only. */
export async function sendPanels(): Promise<void> {
  for (const panel of panels()) {
    await send(kPanel + panel.name, panel.file, panel.blob);
    if (panel.mask) await send(kMask + panel.name, panel.mask.file, panel.mask.blob);
  }
}

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
      added.push({ name, file: file.name, blob: file, mask: null, sample: false });
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
    await send(kMask + panel.name, file.name, file);
  } catch (error) {
    return alertWith(error instanceof Error ? error.message : String(error));
  }
  replace(panel, { ...panel, mask: { file: file.name, blob: file } });
}

export const dropMask = (panel: PanelFile) => replace(panel, { ...panel, mask: null });

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

/** As pictures of a job. */
export const panelPictures = () =>
  panels().flatMap(({ name, file, blob, mask }) => [
    { role: kPanel + name, name: file, blob },
    ...(mask ? [{ role: kMask + name, name: mask.file, blob: mask.blob }] : []),
  ]);
