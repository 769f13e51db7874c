// What a program sees of Tessera's core. Jobs, parameters and techniques describe themselves in `schema`; nothing here
// names a parameter.

/** One problem, as the core reports it. */
export interface Problem {
  code: 'internal' | 'invalidParameter' | 'invalidInput' | 'unwritable' | 'timeout' | 'cancelled';
  /** The parameter ("halfSide") or input ("drawing") it is about; may be empty. */
  field: string;
  /** One line without a full stop: what is wrong and what was expected. */
  message: string;
}

/** Carries every problem there is; its message is theirs, joined. */
export class TesseraError extends Error {
  constructor(readonly problems: readonly Problem[]) {
    super(problems.map((p) => (p.field ? `${p.field} ${p.message}` : p.message)).join('; '));
    this.name = 'TesseraError';
  }
}

export type ParameterValue = number | string | boolean;

/** The reproducible unit of work. `inputs` names pictures for people; the core never opens them. */
export interface Job {
  schemaVersion: 1;
  technique: string;
  seed: number;
  params: Record<string, ParameterValue>;
  inputs: Record<string, string>;
}

/** A parameter in the job's JSON Schema (draft 2020-12), with the words of our own. */
export interface ParameterSchema {
  title: string;
  description: string;
  type: 'number' | 'integer' | 'boolean' | 'string';
  default: ParameterValue;
  minimum?: number;
  maximum?: number;
  enum?: string[];
  'x-enum-descriptions'?: string[];
  'x-ui-minimum'?: number;
  'x-ui-maximum'?: number;
  'x-unit'?: string;
  'x-symbol'?: string;
  'x-advanced'?: boolean;
}

export interface TechniqueSchema {
  title: string;
  description: string;
  properties: Record<string, ParameterSchema>;
  [word: string]: unknown;
}

export interface JobSchema {
  $defs: Record<string, TechniqueSchema>;
  [word: string]: unknown;
}

export interface InputRole {
  name: string; // "drawing", as jobs have it
  help: string; // one line
  required: boolean;
  parameter: string; // that has to be `chosen` for this picture to be looked at; may be empty
  chosen: string;
  many: boolean; // any number of pictures, each with a name: "panel-oak", "panel-walnut"
}

export interface Technique {
  name: string; // "pavement", as jobs have it
  command: string; // "pave", of the command line
  help: string; // one line
  inputs: InputRole[];
  subject: string; // the parameter that says what is made where no picture does ("model"); may be empty
  questions: string[]; // that ask() answers: "plan"
  formats: string[]; // that artifact() makes: "svg", "dxf"
}

/**
 * Pixels as a canvas gives them: RGBA, 8 bits, rows from the top. Transparent pixels are laid over white; a panel of wood is
 * cut where it is opaque.
 */
export interface Picture {
  data: Uint8Array | Uint8ClampedArray;
  width: number;
  height: number;
  dpi?: number; // pixels an inch; 0: nobody knows
}

/** The diagram after an iteration, small enough to draw. */
export interface Preview {
  width: number; // of `cells`, px
  height: number;
  /** A byte a pixel: the zone, plus kCellBorder and kZoneBorder (below). */
  cells: Uint8Array;
  /** Three bytes a zone: the colour of its pieces, sRGB. */
  palette: Uint8Array;
  /** Four numbers a site: x and y in px of the picture, angle in radians (x towards y), zone. */
  sites: Float32Array;
}
export const kZone = 0x3f;
export const kCellBorder = 0x80;
export const kZoneBorder = 0x40;

export interface Iteration {
  index: number; // 0 is the diagram of the first sites
  last: number;
  /** Pixels and sites for a preview of at most so many pixels and sites; only during the callback. */
  draw(maxPixels: number, maxSites: number): Preview;
}

export interface WatchOptions {
  onStage?(stage: string): void;
  /** Done so far, 0 to 1, never falling. */
  onProgress?(fraction: number): void;
}

export interface RunOptions extends WatchOptions {
  /** "auto" takes gl where useCanvas() found graphics hardware, else cpu. Where gl fails on the way, cpu takes over. */
  backend?: 'auto' | 'cpu' | 'gl';
  onWarning?(message: string): void;
  onIteration?(iteration: Iteration): void;
  /** Of techniques that run for long, again and again: `state` tells what has been made so far, only during the callback. */
  onState?(state: () => string): void;
  /** Of such techniques: whether to go on making the result better, asked again and again after all is there. */
  goOnImproving?(): boolean;
}

export interface RunResult {
  backend: string; // that drew the last diagram: "cpu" or "gl"
  counts: Record<string, number>;
  metrics: Record<string, number>;
  job: Job; // that makes the same again: the one that was run, but for how often it was improved
  retouched: boolean; // the PNG shows more than the pieces: noise, a filter
}

/** A finished output. `name` is the extension it answers ("svg"). */
export interface Artifact {
  name: string;
  mediaType: string;
  bytes: Uint8Array;
}

export interface MeasureOptions extends WatchOptions {
  /** A model whose closed forms stand beside ("occupancy"), and its number; without, that of a file's own job. */
  model?: string;
  lambda?: number;
  /** Lengths of needles, or radii; 24 that suit the size. */
  distances?: readonly number[];
  /** Needles a length; 40000. */
  needles?: number;
  /** Colours of a picture; as many as it has. */
  colors?: number;
  /** Width and height; what the file says. */
  window?: readonly [number, number];
  seed?: number;
}

/** A figure: curves have points, histograms values over bins. */
export interface Plot {
  name: string; // "same_cell"
  title: string;
  xLabel: string;
  yLabel: string;
  bins?: string[];
  /** "measured", "closed form" */
  series: { name: string; points?: [number, number][]; values?: number[] }[];
  svg: string;
}

export interface Measured {
  /** What `tessera measure` reports: {"kind": "picture" | "cells" | "points", ...}. */
  report: { kind: 'picture' | 'cells' | 'points'; [word: string]: unknown };
  csv: string; // a row a distance
  plots: Plot[];
}

export interface FitOptions extends WatchOptions {
  seed?: number;
}

/** How well a model explains a picture. */
export interface Candidate {
  model: string;
  lambda: number; // its number: an intensity, or the side of its cells, px of the picture
  distance: number; // in standard deviations, of its own pictures to this one
  w_residual: number; // root mean square of W(d) less the model's
}

export interface Fit {
  model: string;
  lambda: number;
  candidates: Candidate[]; // the best first
  job: Job; // that makes more of the same, as large as the picture
}

/** A morphed grid of parquetry while people work on it. Vertices are counted from 0, places are mm of the finished piece. */
export interface LiveGrid {
  readonly across: number; // cells; there is one vertex more
  readonly down: number;
  readonly widthMm: number;
  readonly heightMm: number;
  /** x and y of each vertex, row by row. */
  vertices(): Float64Array;
  /** The picture's edges, and those of them that the job's edge-mask leaves: a byte a pixel, kLargeEdge, kFineEdge or both. */
  edges(): { width: number; height: number; found: Uint8Array; counting: Uint8Array };
  /** Relaxes by at most so many steps; how many there were: fewer where it has come to rest. */
  step(most: number): number;
  /** Draws a vertex towards a place in the steps that follow. */
  drag(column: number, row: number, x: number, y: number): void;
  /** Lets the vertex go: the parameter "pins" that holds it there, or as near as pieces allow. Then at rest as that job's. */
  lay(): string;
}
export const kLargeEdge = 1;
export const kFineEdge = 2;

/**
 * The core in one thread: every call blocks until it is done, so a page puts it into a worker. Calls throw
 * TesseraError for what is wrong with a job, a picture or a format.
 */
export interface Tessera {
  readonly version: string;
  /** Of the build and this instance; 1 in the build without threads. */
  readonly threads: number;
  readonly schema: JobSchema;
  readonly techniques: Technique[];
  /**
   * Non-zero ends what is going on, at its next check, with the problem "cancelled"; what begins next sets it back. Lies in
   * shared memory where there are threads, so that another thread may set it (Atomics.store); else null.
   */
  readonly stopFlag: Int32Array | null;

  /** Reads a job from its JSON, or from an SVG that carries one. Parameters that it leaves out have their defaults. */
  readJob(text: string): Job;
  /** Every problem of the job's parameters; none: it can run. */
  validate(job: Job): Problem[];
  /** Copies the picture for the runs that follow; null forgets it. */
  setInput(role: string, picture: Picture | null): void;
  /** Offers a canvas for drawing diagrams with WebGL2 (a worker's OffscreenCanvas). What it found, or why there is none. */
  useCanvas(canvas: OffscreenCanvas): { works: boolean; software: boolean; renderer: string };
  /** Runs the job on the pictures that were set. The result is kept for artifact() until the next run. */
  run(job: Job, options?: RunOptions): RunResult;
  /** A file of the last run that was finished, in one of its technique's formats. */
  artifact(format: string): Artifact;
  /** The same of a format of many files: "folder", whose names begin with "folder/". */
  artifacts(format: string): Artifact[];
  /** What one of the technique's questions is answered with for the job and the pictures that were set: lines of text. */
  ask(question: string, job: Job, options?: RunOptions): string;
  /** The job's morphed grid on the pictures that were set: even, about to relax. Only the last one begun may be used. */
  beginGrid(job: Job): LiveGrid;
  /** Closed shapes of an SVG as a label picture, a number each, as the command line takes them for a segmentation. */
  paintShapes(svg: string): Picture;
  /** Statistics of a picture, or of the cells or points in a file's bytes: an SVG made here, GeoJSON, CSV. */
  measure(of: Picture | Uint8Array, options?: MeasureOptions): Measured;
  /** The model of random geometry that a picture of cells in a few colours looks like. */
  fit(picture: Picture, options?: FitOptions): Fit;
}

export interface TesseraOptions {
  /** Threads to use. 1 takes the build without threads, which needs no cross-origin isolation. */
  threads?: number;
  /** Where the package's files are ("tessera-single.wasm"), if not beside this module. */
  locateFile?: (name: string) => string;
  /** The build's .wasm, if it is compiled already: "tessera-threads.wasm", or "tessera-single.wasm" for one thread. */
  wasm?: WebAssembly.Module | undefined;
}
