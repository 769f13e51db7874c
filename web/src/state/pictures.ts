// Where pictures come from: samples, files, the brush, a word. Each runs as soon as it is there.

import { client } from './page';
import { forgetOutcome, generate, prepare, stop } from './runner';
import { kPicture } from '../worker/protocol';
import { kDensity } from './drawn';
import { changeDensity, changeParams, dropCorrections, dropDrawn } from './edits';
import {
  alertWith,
  edits,
  entry,
  inputRole,
  known,
  opening,
  params,
  picture,
  run,
  technique,
  type PictureInfo,
} from './store';
import type { Sample } from '../techniques/entry';

/** The engine's formats that carry a job, and what people call them. */
export const isJobFile = (file: File) => /\.(json|svg)$/i.test(file.name) || /json|svg/.test(file.type);

let newest = 0;

/**
 * True where the picture was taken and is to run; else an alert says why not, and everything stays as it was. Where
 * another tab was opened meanwhile, it is taken, but is none of that tab's.
 */
async function take(fetched: Blob | Promise<Blob>, name: string, sample: string | null): Promise<boolean> {
  const mine = ++newest;
  const { value: asked } = technique;
  const here = () => technique.value === asked;
  opening.value = true;
  const stopped = stop();
  prepare('picture');
  try {
    const [blob] = await Promise.all([fetched, stopped]);
    if (mine !== newest) return false;
    const size = await client.setPicture(kPicture, name, blob);
    if (mine !== newest) return false;
    const old = picture.value;
    if (here() && (old?.width !== size.width || old.height !== size.height)) forgetOutcome();
    picture.value = { name, sample, width: size.width, height: size.height } satisfies PictureInfo;
    return here() && run.value !== null; // else cancelled meanwhile
  } catch (error) {
    if (mine === newest) {
      if (here()) run.value = null;
      alertWith(error instanceof Error ? error.message : String(error));
    }
    return false;
  } finally {
    if (mine === newest) opening.value = false;
  }
}

/** The technique's picture; where it needs none, one that tells where points are many. */
export async function usePicture(blob: Blob, name: string): Promise<void> {
  if (!inputRole.value) return useDensity(blob, name);
  if (!(await take(blob, name, null))) return;
  dropDrawn();
  dropCorrections();
  generate();
}

async function useDensity(blob: Blob, name: string): Promise<void> {
  const role = known.value?.inputs.find((input) => input.name === kDensity);
  if (!role) return;
  try {
    await client.setPicture(kDensity, name, blob);
  } catch (error) {
    return alertWith(error instanceof Error ? error.message : String(error));
  }
  const all = { ...params.value, [role.parameter]: role.chosen };
  changeDensity({ name, blob }, entry.value.forDensity?.(all) ?? all);
}

/** What a sample wants comes with it, and goes with it: four colours for a picture in four. `keep`: it does not. */
export async function useSample(sample: Sample, keep = false): Promise<void> {
  if (!(await take(fetchSample(sample), sample.file, sample.name))) return;
  if (!keep) followSample(sample);
  generate();
}

async function fetchSample({ file, title }: Sample): Promise<Blob> {
  try {
    const response = await fetch(`samples/${file}`);
    if (response.ok) return await response.blob();
  } catch {
    // As below.
  }
  throw new Error(`The sample “${title}” could not be loaded. Check the connection, or use a picture of yours.`);
}

function followSample(sample: Sample): void {
  const own = { ...edits.value.present.params };
  const named = new Set(entry.value.samples.flatMap((s) => Object.keys(s.params ?? {})));
  for (const key of named) delete own[key];
  changeParams({ ...own, ...sample.params });
  dropDrawn();
  dropCorrections();
}

export const sampleNamed = (name: string | null): Sample | undefined =>
  entry.value.samples.find((sample) => sample.name === name || sample.file === name);
