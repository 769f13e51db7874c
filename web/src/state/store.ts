// What the page knows. Everything shown follows from these signals; only the modules beside this one set them.

import { computed, signal } from '@preact/signals';
import type { Job, RunResult } from 'tessera-wasm';
import { schema, techniques } from 'tessera-wasm/description';
import { pavement } from '../techniques/pavement';
import type { Tool } from '../techniques/entry';
import { entryOf } from '../techniques/index';
import type { Size } from '../stage/view';
import type { Backend, ColourCount, EngineInfo, Graphics, PieceFacts, Wood } from '../worker/protocol';
import type { Pieces } from '../worker/pieces';
import { fieldsOf, valueOf, type Params } from './form';
import { kNothingDrawn, type Drawn, type PictureFile } from './drawn';
import { historyOf, type History } from './history';

/** What undo and redo walk through. */
export interface Edits {
  params: Params;
  seed: number;
  drawn: Drawn;
}

export const freshEdits = (params: Params = {}, seed = 1): History<Edits> =>
  historyOf({ params, seed, drawn: kNothingDrawn });

export interface PictureInfo extends Size {
  name: string;
  /** The sample's name, or null for the visitor's own. */
  sample: string | null;
}

/** The parameter that says how pebbles are found, and its value for a label picture. */
export const kSegmenter = 'segmenter';
export const kByLabels = 'labels';

/** The parameter that tells which corners of a grid people have laid on the picture. */
export const kPins = 'pins';

export interface Run {
  stage: string;
  fraction: number;
  iteration: { index: number; last: number } | null;
  since: number;
  /** On a smaller copy, with the whole to follow. */
  reduced: boolean;
}

export interface FileLink {
  address: string;
  name: string;
  blob: Blob;
}

export interface Outcome {
  job: Job;
  result: RunResult;
  milliseconds: number;
  reduced: boolean;
  colours: readonly ColourCount[];
  /** Of techniques whose pieces are solid. */
  pieces: Pieces | null;
  /** Of a technique that is made of wood. */
  wood: Wood | null;
  /** Files besides the picture are made when they are asked for. */
  onDemand: boolean;
  /** By format; grows while the files are made. */
  files: Readonly<Record<string, FileLink>>;
}

/** The one that computes; null until it is there. The page is made without it, and jobs wait for it. */
export const engine = signal<EngineInfo | null>(null);
/** What draws where a graphics card is asked for; null until that has been looked for. */
export const graphics = signal<Graphics | null>(null);
export const technique = signal(pavement.name);
export const edits = signal<History<Edits>>(freshEdits());
export const picture = signal<PictureInfo | null>(null);
/** A label picture made elsewhere, which says where the pebbles of this picture are. */
export const labels = signal<PictureFile | null>(null);
/** The size of a sheet that has a picture to be compared with. */
export const compared = signal<Size | null>(null);
/** A picture is on its way; it runs as soon as it is there. */
export const opening = signal(false);
export const run = signal<Run | null>(null);
export const outcome = signal<Outcome | null>(null);
/** What became of the last run, in a few words for everybody: "Cancelled". */
export const notice = signal('');
export const alerts = signal<readonly string[]>([]);
/** Problems of single parameters, by key. */
export const problems = signal<Readonly<Record<string, string>>>({});
export const backend = signal<Backend>('auto');
export const piece = signal<PieceFacts | null>(null);
/** What the pointer does on the stage instead of moving it. */
export const tool = signal<Tool | null>(null);

/** What is done on the stage is done to a grid that the engine relaxes meanwhile; nothing runs until it is left. */
export const shaping = computed(() => tool.value === 'grid' || tool.value === 'edges');

export const entry = computed(() => entryOf(technique.value) ?? pavement);
export const params = computed(() => edits.value.present.params);
/** Whether the label picture is what this technique searches by. */
export const byLabels = computed(() => params.value[kSegmenter] === kByLabels);
export const fields = computed(() =>
  fieldsOf(schema, technique.value, labels.value || byLabels.value ? {} : entry.value.without),
);
export const seed = computed(() => edits.value.present.seed);
export const drawn = computed(() => edits.value.present.drawn);
/** The engine's word on the technique. */
export const known = computed(() => techniques.find((t) => t.name === technique.value));
/** What the technique calls the picture that it is made of; empty where it needs none. */
export const inputRole = computed(() => known.value?.inputs.find(({ required }) => required)?.name ?? '');
/** The size of pieces without a picture: of those which are shown, so that a sheet grows together with them. */
const sheetSize = computed<Size>(() => {
  const { width, height } = outcome.value?.job.params ?? currentParams();
  return { width: Math.max(1, Number(width)), height: Math.max(1, Number(height)) };
});
/** What lies on the stage, px: the picture, or where none is needed a sheet as large as the parameters say. */
export const sheet = computed(() => (inputRole.value ? picture.value : sheetSize.value));

/** The grid follows the picture. */
export const isMorphed = (values: Params): boolean => values['grid'] === 'morphed';

/** Whether the tools have anything to do: a grid has no corners to drag where the pieces come from elsewhere. */
export const usesTools = computed(() => !drawn.value.shapes && (entry.value.usesTools?.(params.value) ?? true));

/** Every parameter's value. */
export const currentParams = (): Params =>
  Object.fromEntries(fields.value.map((field) => [field.key, valueOf(field, params.value)]));

export const alertWith = (...messages: string[]): void => {
  alerts.value = messages;
};
export const clearAlerts = () => {
  if (alerts.value.length) alerts.value = [];
};
