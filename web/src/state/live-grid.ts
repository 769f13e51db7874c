// The morphed grid while people work on it: the engine relaxes it frame by frame, also while a vertex is dragged, and says
// where the job will have it once that is let go. Its pins are a parameter, and undone as others.

import { batch, effect, signal, untracked } from '@preact/signals';
import type { Point } from '../stage/view';
import type { Drag, GridSize } from '../worker/protocol';
import { changeValues, endStep } from './edits';
import { client } from './page';
import { pinOf, readPins, withoutPin, type Pin, type Vertex } from './pins';
import { askingNow, pause, runOwed, showProblems } from './runner';
import {
  alertWith,
  clearAlerts,
  drawn,
  kPins,
  params,
  picture,
  seed,
  shaping,
  tool,
  usesTools,
  type PictureInfo,
} from './store';
import { calm } from './theme';

const kPace = 0.18; // steps a millisecond, however many frames there are
const kMostSteps = 30; // a frame
const kGlide = 250; // ms

export interface Shown extends GridSize {
  /** Where it is seen, mm: x and y of each vertex, row by row. */
  readonly vertices: Float64Array;
  /** Of the engine's, since it began. */
  readonly steps: number;
  /** The engine has it as the job will. */
  readonly atRest: boolean;
}

export const grid = signal<Shown | null>(null);
/** The edges that it follows. */
export const gridEdges = signal<ImageBitmap | null>(null);
/** It goes to where the engine has it already. */
export const gliding = signal(false);
/** The vertex that keys move, or that was pressed last. */
export const chosen = signal<Vertex | null>(null);
/** The vertex that is being dragged, and where to, mm. */
export const dragged = signal<Drag | null>(null);

const pins = () => String(params.value[kPins] ?? '');
export const laidPins = (): Pin[] => readPins(pins());

const nextFrame = () => new Promise<number>((resolve) => requestAnimationFrame(resolve));

let newest = 0; // what a change has begun; an older one is forgotten
let of: PictureInfo | null = null; // the picture that the grid is of
let relaxing = false;
let laying = false;

/** While a tool for the grid is in use, it follows all that changes. */
export function bindGrid(): void {
  effect(() => {
    if (!shaping.value) return untracked(close);
    if (!usesTools.value) {
      tool.value = null;
      return;
    }
    void [params.value, drawn.value, seed.value];
    const { value: now } = picture;
    untracked(() => void begin(now));
  });
}

function close(): void {
  if (!of && !grid.value) return;
  ++newest;
  of = null;
  batch(() => {
    grid.value = gridEdges.value = chosen.value = dragged.value = null;
  });
  runOwed();
}

/** The first time even, about to relax; after a change as the job will have it. */
async function begin(now: PictureInfo | null): Promise<void> {
  const mine = ++newest;
  const first = of !== now || !grid.value;
  of = now;
  dragged.value = null;
  if (!now) return;
  if (first) await pause();
  try {
    const asking = await askingNow(now);
    if (mine !== newest) return;
    const settled = !first || calm.value;
    const begun = await client.beginGrid(asking, settled);
    if (mine !== newest || !begun) return;
    if (begun.type === 'problems') return showProblems(begun.problems);
    clearAlerts();
    gridEdges.value?.close();
    gridEdges.value = begun.edges;
    const shown: Shown = { ...begun.size, vertices: begun.vertices, steps: 0, atRest: settled };
    if (settled) return await glideTo(shown);
    grid.value = shown;
    void relax();
  } catch (error) {
    if (mine === newest) alertWith(error instanceof Error ? error.message : String(error));
  }
}

async function relax(): Promise<void> {
  if (relaxing) return;
  relaxing = true;
  let last = performance.now();
  while (grid.value && !laying && (dragged.value || !grid.value.atRest)) {
    const mine = newest;
    const frame = nextFrame();
    const now = performance.now();
    const most = Math.min(kMostSteps, Math.max(1, Math.round(kPace * (now - last))));
    last = now;
    const answer = await client.relaxGrid(most, dragged.value);
    if (!answer) break;
    if (mine === newest && grid.value && !laying && !gliding.value) {
      const { vertices, steps } = answer;
      grid.value = { ...grid.value, vertices, steps: grid.value.steps + steps, atRest: steps < most };
    }
    await frame;
  }
  relaxing = false;
}

async function glideTo(goal: Shown): Promise<void> {
  const mine = newest;
  const from = grid.value?.vertices;
  if (from?.length === goal.vertices.length && !calm.value) {
    gliding.value = true;
    const since = performance.now();
    for (let now = since; now < since + kGlide; now = await nextFrame()) {
      if (mine !== newest || dragged.value || !grid.value) break;
      const part = Math.max(0, now - since) / kGlide;
      const vertices = goal.vertices.map((place, i) => from[i]! + part * (place - from[i]!));
      grid.value = { ...grid.value, vertices, atRest: true };
    }
    gliding.value = false;
  }
  if (mine === newest && !dragged.value) grid.value = { ...goal, steps: grid.value?.steps ?? 0 };
}

/** Where a vertex is seen, mm. */
export function placeOf({ column, row }: Vertex): Point {
  const { across = 0, vertices } = grid.value ?? {};
  const i = row * (across + 1) + column;
  return { x: vertices?.[2 * i] ?? 0, y: vertices?.[2 * i + 1] ?? 0 };
}

/** The vertex nearest to a place, mm, but for the four that cannot move; null where none is so near. */
export function vertexAt({ x, y }: Point, reach: number): Vertex | null {
  const { across = 0, down = 0, vertices } = grid.value ?? {};
  let best: Vertex | null = null;
  let nearest = reach;
  for (let row = 0; vertices && row <= down; ++row)
    for (let column = 0; column <= across; ++column) {
      const i = row * (across + 1) + column;
      const away = Math.hypot(vertices[2 * i]! - x, vertices[2 * i + 1]! - y);
      if (away > nearest || ((row === 0 || row === down) && (column === 0 || column === across))) continue;
      nearest = away;
      best = { column, row };
    }
  return best;
}

export function drag(vertex: Vertex, to: Point): void {
  dragged.value = { ...vertex, ...to };
  void relax();
}

/** What was dragged stays there: the job's pins. */
export async function lay(): Promise<void> {
  if (!dragged.value) return;
  dragged.value = null;
  laying = true;
  const mine = newest;
  const answer = await client.layVertex();
  laying = false;
  if (!answer || mine !== newest || !grid.value) return;
  if (answer.pins === pins()) void glideTo({ ...grid.value, vertices: answer.vertices, atRest: true });
  else changeValues({ [kPins]: answer.pins }); // and then as after any change
  endStep();
}

/** As it was before it was dragged. */
export function leaveDrag(): void {
  dragged.value = null;
  void begin(of);
}

export const isLaid = (vertex: Vertex) => pinOf(pins(), vertex) !== undefined;

export function release(vertex: Vertex): void {
  changeValues({ [kPins]: withoutPin(pins(), vertex) });
  endStep();
}

export function releaseAll(): void {
  changeValues({ [kPins]: '' });
  endStep();
}
