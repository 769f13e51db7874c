// Fitting a picture: the model of random geometry that it looks like, as a job that makes more of the same.

import { signal } from '@preact/signals';
import type { Fit, Problem } from 'tessera-wasm';
import { kPicture } from '../worker/protocol';
import { changeParams, dropDrawn } from './edits';
import { differing } from './form';
import { client } from './page';
import { generate, stop } from './runner';
import { engineTaken } from './statistics';
import { compared, drawn, fields, picture, run } from './store';

export interface PictureFile {
  name: string;
  blob: Blob;
}

export const fitting = signal<{ name: string; fraction: number } | null>(null);
export const fitted = signal<{ name: string; fit: Fit } | null>(null);
export const fitProblem = signal('');

/** Pictures that the page has already: that of the other tabs, and that of densities. */
export function knownPictures(): PictureFile[] {
  const { density } = drawn.value;
  const other = picture.value && client.held(kPicture);
  return [...(density ? [density] : []), ...(other ? [other] : [])];
}

const sentence = (name: string, { message }: Problem) =>
  `“${name}” ${message}. Choose a picture of cells in a few colours.`;

export async function fitPicture(blob: Blob, name: string): Promise<void> {
  const interrupted = run.value !== null;
  engineTaken.value = true;
  fitting.value = { name, fraction: 0 };
  fitted.value = compared.value = null;
  fitProblem.value = '';
  await stop();
  try {
    const answer = await client.fit(name, blob, (fraction) => (fitting.value = { name, fraction }));
    if (answer && 'candidates' in answer) fitted.value = { name, fit: answer };
    else if (answer)
      fitProblem.value = answer
        .filter((p) => p.code !== 'cancelled')
        .map((p) => sentence(name, p))
        .join(' ');
  } catch (error) {
    fitProblem.value = error instanceof Error ? error.message : String(error);
  }
  fitting.value = null;
  engineTaken.value = false;
  if (interrupted && !run.value) generate();
}

/** Whatever else is asked of the engine ends it as well. */
export const cancelFit = () => client.cancel();

/** Takes the fitted job over, and runs it; the picture is there to be compared with. */
export function useFit({ job }: Fit): void {
  changeParams(differing(fields.value, job.params), job.seed);
  dropDrawn();
  compared.value = { width: Number(job.params['width']), height: Number(job.params['height']) };
  generate();
}
