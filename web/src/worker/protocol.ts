// What the page, the engine's worker and the painter's worker say to each other.

import type { Fit, Job, LiveGrid, Measured, Preview, Problem, RunResult } from 'tessera-wasm';
import type { Point, Size, View } from '../stage/view';
import type { Pieces } from './pieces';

export type Backend = 'auto' | 'cpu' | 'gl';

export interface Graphics {
  works: boolean;
  software: boolean;
  renderer: string;
}

/** A colour of pieces ("#f4f1e8"), and of how many. */
export interface ColourCount {
  colour: string;
  count: number;
}

export interface EngineInfo {
  version: string;
  threads: number;
}

/** Where the worker keeps the picture that is on the stage; other slots have pictures that were drawn over it. */
export const kPicture = 'picture';

/** The role, and the slot, of a label picture: its pixels are numbers, not colours. An SVG of closed shapes is painted as one. */
export const kLabels = 'segmentation';

/** Roles, and slots, of scans of wood and of their masks are these with a name: "panel-oak". */
export const kPanel = 'panel-';
export const kMask = 'mask-';

/** The role, and the slot, of the mask that says which edges a morphed grid follows; and its file. */
export const kEdgeMask = 'edge-mask';
export const kEdgeMaskFile = `${kEdgeMask}.png`;

/** The file of a mask that was corrected on the page. */
export const maskFileOf = (panel: string): string => `${panel}-mask.png`;

/** A panel as the page knows it before it is asked of the engine. */
export interface PanelScale {
  /** "oak". */
  name: string;
  /** 0: as its file says. */
  dpi: number;
}

/** A piece of wood: rows and columns of numbers are in millimetres, degrees turn clockwise. */
export interface WoodPiece {
  /** "C12". */
  id: string;
  row: number;
  column: number;
  panel: string;
  /** Its outline's corners on the panel, x and y, from the scan's top left. */
  onPanel: number[];
  /** How far it is turned from the panel to the finished piece. */
  turn: number;
  cost: number;
}

/** What a panel looks like: its scan, or what has been made of it. */
export interface PanelPicture {
  name: string;
  widthMm: number;
  heightMm: number;
  picture: Blob;
  /** Its pieces' names, in the order they are cut. */
  order: string[];
}

/** What became of the wood. `pieces`: in the order of the run's. */
export interface Wood {
  pieces: WoodPiece[];
  panels: PanelPicture[];
  assembly: Blob;
  /** Pixels of the run's pieces to one of the first target's. */
  scale: number;
}

/** What is asked of the engine about a job and its pictures. */
export interface Asking {
  job: Job;
  /** As a run's. */
  inputs: Readonly<Record<string, string>>;
}

export type GridSize = Pick<LiveGrid, 'across' | 'down' | 'widthMm' | 'heightMm'>;

/** A vertex of a grid, and a place, mm. */
export interface Drag {
  column: number;
  row: number;
  x: number;
  y: number;
}

export interface RunRequest {
  job: Job;
  /** The slot of each picture that the job has, by its role. */
  inputs: Readonly<Record<string, string>>;
  backend: Backend;
  /** Side of the picture to run on, as a part of the whole's; below 1 no files are made. */
  scale: number;
  /** Files to make once the pieces are there, in this order. */
  formats: string[];
  /** The page wants the pieces, too. */
  pieces: boolean;
  /** Seconds in which it is made better once it is there; 0: as the job says. */
  improve: number;
  /** Of a technique that is made of wood: its panels. */
  panels: readonly PanelScale[] | null;
}

/** The file that statistics are taken from: cells or points as they are, or the picture of them. */
export type Measurable = 'svg' | 'png';

export type ToEngine =
  | { type: 'painter'; port: MessagePort }
  /** `graphics`: what an earlier engine of this page found, so as not to look again. */
  | { type: 'boot'; base: string; threads: number; wasm: WebAssembly.Module | undefined; graphics: Graphics | null }
  | { type: 'picture'; id: number; slot: string; name: string; blob: Blob }
  | { type: 'run'; id: number; request: RunRequest }
  | { type: 'ask'; id: number; question: string; asking: Asking }
  /** The job's morphed grid, to be worked on: even, or `settled`. */
  | { type: 'grid'; id: number; asking: Asking; settled: boolean }
  /** So many steps of that, with a vertex drawn to a place. */
  | { type: 'relax'; id: number; steps: number; drag: Drag | null }
  /** That vertex is let go. */
  | { type: 'lay'; id: number }
  /** One more file of a run that is done. */
  | { type: 'file'; id: number; run: number; format: string }
  | { type: 'read'; id: number; text: string }
  /** Statistics of a run that is done, from that file of it. */
  | { type: 'measure'; id: number; run: number; of: Measurable }
  | { type: 'fit'; id: number; name: string; blob: Blob };

export type FromEngine =
  | { type: 'ready'; info: EngineInfo; stopFlag: Int32Array | null }
  | { type: 'broken'; message: string }
  | { type: 'graphics'; graphics: Graphics }
  /** `panel`: of a panel, in the slot that says so. */
  | { type: 'picture'; id: number; width: number; height: number; panel: { dpi: number; small: Blob } | null }
  /** Before a run: whether the wood suffices, in lines. */
  | { type: 'forecast'; id: number; text: string }
  /** Pieces of wood that have been laid since the last time. */
  | { type: 'laid'; id: number; pieces: WoodPiece[] }
  | { type: 'answer'; id: number; text: string }
  /** Vertices are x and y of each, mm, row by row. */
  | { type: 'grid'; id: number; size: GridSize; vertices: Float64Array; edges: ImageBitmap }
  /** `steps`: how many there were; none where it was at rest. */
  | { type: 'relaxed'; id: number; vertices: Float64Array; steps: number }
  /** `pins`: the parameter. */
  | { type: 'lain'; id: number; vertices: Float64Array; pins: string }
  | { type: 'refused'; id: number; message: string }
  | { type: 'stage'; id: number; stage: string }
  | { type: 'progress'; id: number; fraction: number }
  | { type: 'iteration'; id: number; index: number; last: number }
  | { type: 'warning'; id: number; message: string }
  | {
      type: 'done';
      id: number;
      result: RunResult;
      milliseconds: number;
      colours: ColourCount[];
      pieces: Pieces | null;
      wood: Wood | null;
      /** Pieces are so many that files besides the picture are made when they are asked for. */
      onDemand: boolean;
    }
  | { type: 'problems'; id: number; problems: Problem[] }
  | { type: 'file'; id: number; format: string; blob: Blob }
  | { type: 'job'; id: number; job: Job }
  | { type: 'measured'; id: number; measured: Measured }
  | { type: 'fitted'; id: number; fit: Fit };

/**
 * Straight from the engine's worker to the painter's: pixels do not pass through the page. `id` is the run's. Pieces of a
 * seamless sheet stick out of it, and come in at the other side. `face`: what is seen of them, where that is more than
 * themselves.
 */
export type EngineToPainter =
  | { type: 'source'; bitmap: ImageBitmap; width: number; height: number }
  /** What a sheet is compared with, that was made without a picture. */
  | { type: 'compared'; bitmap: ImageBitmap }
  | { type: 'preview'; id: number; preview: Preview; scale: number }
  /** As much as there is of a picture that grows piece by piece. */
  | { type: 'growing'; id: number; bitmap: ImageBitmap }
  | {
      type: 'pieces';
      id: number;
      pieces: Pieces;
      ground: string;
      scale: number;
      seamless: boolean;
      face: ImageBitmap | null;
    };

export const kLayers = ['source', 'edges', 'direction', 'sites', 'cells', 'outlines', 'stones'] as const;
export type Layer = (typeof kLayers)[number];
export type Layers = Readonly<Record<Layer, boolean>>;

export interface Look {
  layers: Layers;
  /** Part of the stage, from its left, that shows the source. */
  divider: number;
  accent: string;
  line: string;
  /** No transitions. */
  calm: boolean;
}

export type ToPainter =
  | { type: 'canvas'; canvas: OffscreenCanvas }
  | { type: 'engine'; port: MessagePort }
  | { type: 'stage'; width: number; height: number; ratio: number }
  | { type: 'view'; view: View }
  /** There is no picture: pieces lie on a sheet of this size. Null: on the picture. */
  | { type: 'sheet'; sheet: Size | null }
  /** Pieces go beyond the picture: so far, px of it. Null: they do not. */
  | { type: 'extent'; extent: Size | null }
  | { type: 'look'; look: Look }
  | { type: 'point'; at: Point | null }
  /** Forget runs up to this one that have not come to an end. */
  | { type: 'drop'; upTo: number };

export interface PieceFacts {
  kind: string;
  id: number;
  area: number;
  vertices: number;
  orientation: number;
}

export type FromPainter =
  | { type: 'piece'; piece: PieceFacts | null }
  /** The first picture has been drawn, and the frame with it is over. */
  | { type: 'shown' };
