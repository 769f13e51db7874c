// Runs: one at a time, the newest wins, an older one is stopped and never waits.

import { batch } from '@preact/signals';
import type { Job, Problem } from 'tessera-wasm';
import { schema } from 'tessera-wasm/description';
import { kEdgeMask, kLabels, kPicture, type Asking } from '../worker/protocol';
import { drawnPictures, type DrawnPicture } from './drawn';
import { endingOf, fileKinds } from './files';
import type { Size } from '../stage/view';
import { client } from './page';
import {
  fetchPanels,
  forecast,
  improveFor,
  kPanels,
  laid,
  ownOptions,
  panelPictures,
  panelScales,
  sendPanels,
} from './panels';
import { reducedJob, reductionFor } from './reduce';
import { sendPicture } from './sent';
import {
  alerts,
  alertWith,
  backend,
  byLabels,
  clearAlerts,
  currentParams,
  drawn,
  entry,
  fields,
  inputRole,
  isMorphed,
  known,
  kPins,
  labels,
  notice,
  opening,
  outcome,
  params,
  picture,
  problems,
  run,
  seed,
  shaping,
  sheet,
  technique,
  tool,
  type FileLink,
} from './store';

const kPause = 150; // ms of peace before a changed parameter runs
const kShort = 250; // ms; a run that needs no more comes to its end before the next one

let newest = 0;
let timer = 0;
let owed = false; // a run, once the grid is left

/** Complete, so that it means the same where defaults are others. */
function currentJob(drawnOnes: readonly DrawnPicture[]): Job {
  return {
    schemaVersion: 1,
    technique: technique.value,
    seed: seed.value,
    params: { ...currentParams(), ...(entry.value.panels && woodParams()) },
    inputs: {
      ...(inputRole.value && picture.value && { [inputRole.value]: picture.value.name }),
      ...(byLabels.value && labels.value && { [kLabels]: labels.value.name }),
      ...Object.fromEntries(drawnOnes.map(({ role, name }) => [role, name])),
    },
  };
}

/** Of what there is: panels, and corners of a grid that has corners to lay. */
const woodParams = () => ({ [kPanels]: ownOptions(), ...(!isMorphed(params.value) && { [kPins]: '' }) });

/** From now on what is there counts as old; its files are not offered any more. */
export function prepare(stage = ''): void {
  batch(() => {
    clearTimeout(timer);
    clearAlerts();
    notice.value = '';
    run.value = { stage, fraction: 0, iteration: null, since: performance.now(), reduced: false };
  });
}

/** A picture that is to be the job's is on its way; it runs as soon as it is there. */
const waits = () => opening.value && inputRole.value !== '';

/**
 * After a change of a parameter: soon, and where the picture is large on a smaller copy first. Without a picture at
 * once, as pieces come while a slider is dragged.
 */
export function runSoon(): void {
  if (shaping.value) {
    owed = true;
    return;
  }
  if (waits()) return prepare('picture');
  prepare();
  timer = window.setTimeout(() => void start(true), inputRole.value ? kPause : 0);
}

export function generate(): void {
  if (shaping.value) tool.value = null;
  if (waits()) return prepare('picture');
  prepare();
  void start(false);
}

/** Nothing runs from now on, until runOwed(). */
export async function pause(): Promise<void> {
  owed ||= run.value !== null;
  await stop();
}

/** What there was no run for meanwhile. */
export function runOwed(): void {
  if (owed && !run.value) runSoon();
}

/** Stops what runs and what is about to; what was there before stays. */
export async function stop(): Promise<void> {
  clearTimeout(timer);
  ++newest;
  run.value = null;
  await client.cancel();
}

export function cancel(): void {
  void stop();
  notice.value = 'Cancelled';
}

async function start(quick: boolean): Promise<void> {
  const mine = ++newest;
  owed = false;
  if (quick && !inputRole.value) await client.settled(kShort); // else a drag would show none but its last
  if (mine !== newest) return;
  await client.cancel();
  if (mine !== newest) return;
  const { value: size } = sheet;
  if (!size) {
    run.value = null;
    return;
  }
  let asked: Awaited<ReturnType<typeof askingNow>>;
  try {
    asked = await askingNow(size);
  } catch (error) {
    if (mine !== newest) return;
    run.value = null;
    return alertWith(error instanceof Error ? error.message : String(error));
  }
  if (mine !== newest) return;
  const { job } = asked;
  const part =
    quick && inputRole.value && !entry.value.solid && !entry.value.panels ? reductionFor(size.width, size.height) : 1;
  if (part < 1 && !(await attempt(mine, reducedJob(job, schema, part), part, []))) return;
  await attempt(mine, job, 1, asked.drawnOnes);
}

/** The job as it is, with pictures that the engine has. Rejects with a message for people. */
export async function askingNow(size: Size): Promise<Asking & { drawnOnes: DrawnPicture[] }> {
  await fetchPanels();
  await sendPanels();
  if (byLabels.value && labels.value) await sendPicture(kLabels, labels.value.name, labels.value.blob);
  const drawnOnes = [...(await takeDrawn(size)), ...(await panelPictures())];
  const job = currentJob(drawnOnes);
  return { job, inputs: inputsOf(job), drawnOnes };
}

const inputsOf = ({ inputs }: Job) =>
  Object.fromEntries(Object.keys(inputs).map((role) => [role, role === inputRole.value ? kPicture : role]));

/** What is drawn over the picture now, as pictures that the engine has. */
async function takeDrawn(size: Size): Promise<DrawnPicture[]> {
  const all = await drawnPictures(drawn.value, size);
  const pictures = all.filter(({ role }) => role !== kEdgeMask || isMorphed(params.value));
  for (const { role, name, blob } of pictures) await sendPicture(role, name, blob);
  return pictures;
}

/** True where it ran to its end and is still wanted. */
async function attempt(mine: number, job: Job, scale: number, drawnOnes: readonly DrawnPicture[]): Promise<boolean> {
  if (mine !== newest) return false;
  const reduced = scale < 1;
  batch(() => {
    problems.value = {};
    run.value = { stage: '', fraction: 0, iteration: null, since: performance.now(), reduced };
    laid.value = [];
  });
  const warn = (message: string) => {
    if (mine !== newest) return;
    if (entry.value.panels) alertWith(...alerts.value, `${message}.`);
    else notice.value = message;
  };
  const update = (change: Partial<NonNullable<typeof run.value>>) => {
    if (mine === newest && run.value) run.value = { ...run.value, ...change };
  };
  const formats = fileKinds.value
    .filter(({ format, onDemand }) => !onDemand && known.value?.formats.includes(format))
    .map(({ format }) => format);
  const baseName = baseNameOf(subjectOf(job), job.technique);
  let done = job; // that makes the same again
  const end = await client.run(
    {
      job,
      inputs: inputsOf(job),
      backend: backend.value,
      scale,
      formats,
      pieces: entry.value.solid || entry.value.panels !== undefined,
      improve: entry.value.panels ? improveFor.value : 0,
      panels: entry.value.panels ? panelScales() : null,
    },
    {
      stage: (stage) => update({ stage }),
      progress: (fraction) => update({ fraction }),
      iteration: (index, last) => update({ iteration: { index, last } }),
      warning: warn,
      forecast: (text) => mine === newest && (forecast.value = text),
      laid: (pieces) => mine === newest && (laid.value = [...laid.value, ...pieces]),
      file: (format, blob) =>
        outcome.value?.job === done && addFile(format, { blob, name: `${baseName}.${endingOf(format)}` }),
    },
  );
  if (mine !== newest) return false;
  batch(() => {
    run.value = null;
    if (end.kind === 'done') {
      forgetFiles();
      const { kind, ...made } = end;
      done = { ...job, params: { ...job.params, ...made.result.job.params } };
      outcome.value = { job: done, reduced, ...made, files: {} };
      if (!reduced) addFile('job', { blob: jobBlob(done), name: `${baseName}.${endingOf('job')}` });
      for (const { role, ...file } of drawnOnes) addFile(role, file);
    } else if (end.kind === 'problems') {
      showProblems(end.problems);
    }
  });
  return end.kind === 'done';
}

/** A file that is made on demand; null where the run that it was to come from is over by now. */
export async function demandFile(format: string): Promise<FileLink | null> {
  const { value: wanted } = outcome;
  if (!wanted) return null;
  const before = wanted.files[format];
  if (before) return before;
  const blob = await client.makeFile(format);
  if (outcome.value?.job !== wanted.job) return null;
  if (blob)
    addFile(format, { blob, name: `${baseNameOf(subjectOf(wanted.job), wanted.job.technique)}.${endingOf(format)}` });
  else notice.value = 'Generate once more to make this file';
  return outcome.value.files[format] ?? null;
}

/** What a job is made of, by name: its picture, or the parameter that stands in for one. */
const subjectOf = ({ params }: Job): string =>
  inputRole.value ? (picture.value?.name ?? 'drawing') : String(params[known.value?.subject ?? ''] ?? '');

/** "coast-mosaic" of coast.png, "hexagon-pattern". */
function baseNameOf(subject: string, name: string): string {
  const stem = subject.replace(/\.[^.]*$/, '');
  return stem === name ? stem : `${stem}-${name}`;
}

const jobBlob = (job: Job) => new Blob([`${JSON.stringify(job, null, 2)}\n`], { type: 'application/json' });

function addFile(format: string, { blob, name }: { blob: Blob; name: string }): void {
  const { value } = outcome;
  if (!value) return;
  const link: FileLink = { address: URL.createObjectURL(blob), name, blob };
  outcome.value = { ...value, files: { ...value.files, [format]: link } };
}

/** The result goes, with the memory that its files hold. */
export function forgetOutcome(): void {
  forgetFiles();
  outcome.value = null;
}

function forgetFiles(): void {
  for (const { address } of Object.values(outcome.value?.files ?? {})) URL.revokeObjectURL(address);
}

export function showProblems(found: readonly Problem[]): void {
  const told = found.filter((problem) => problem.code !== 'cancelled');
  const byField: Record<string, string> = {};
  for (const { code, field, message } of told) if (code === 'invalidParameter' && field) byField[field] = message;
  problems.value = byField;
  alerts.value = told.map(sentenceOf);
  if (told.some((problem) => problem.code === 'internal')) client.restart(); // it may be in disorder
}

function sentenceOf({ code, field, message }: Problem): string {
  if (code === 'internal') return `The run failed: ${message}. Try it once more, or with a smaller picture.`;
  const title = fields.value.find((f) => f.key === field)?.title;
  if (title) return `${title} ${message}.`;
  const names: Readonly<Record<string, string | undefined>> = {
    [inputRole.value]: picture.value?.name ?? entry.value.title,
    [kLabels]: drawn.value.shapes?.name ?? labels.value?.name,
    [kEdgeMask]: 'The mask of edges',
  };
  const panel = entry.value.panels && field === 'panel' ? 'A panel of wood' : undefined;
  const what = panel ?? (names[field] ? `“${names[field]}”` : field);
  return what ? `${what} ${message}.` : `${message}.`;
}
