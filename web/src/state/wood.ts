// The piece that is pointed at, on the finished picture or on the wood, or was chosen there.

import { computed, signal } from '@preact/signals';
import { gridOf, pieceAt } from '../stage/grid';
import type { Point } from '../stage/view';
import type { WoodPiece } from '../worker/protocol';
import { laid } from './panels';
import { outcome, piece, run } from './store';

const done = computed(() => (run.value ? null : (outcome.value?.wood ?? null)));
const grid = computed(() => outcome.value?.pieces && gridOf(outcome.value.pieces));

/** What has been cut, so far or in the end. */
export const cuts = computed<readonly WoodPiece[]>(() => (run.value ? laid.value : (done.value?.pieces ?? [])));

/** Of the run that is shown; another one forgets it. */
const choice = signal<{ of: unknown; index: number }>({ of: null, index: -1 });
/** On the wood, under the pointer; -1: nothing. */
export const pointed = signal(-1);

const onStage = computed(() => (piece.value ? (outcome.value?.pieces?.ids.indexOf(piece.value.id) ?? -1) : -1));
const pinned = computed(() => (choice.value.of === done.value ? choice.value.index : -1));

/** Index of the piece to tell of; -1: none. */
export const shownPiece = computed(() =>
  done.value ? ([pointed.value, onStage.value, pinned.value].find((index) => index >= 0) ?? -1) : -1,
);

export const choosePiece = (index: number) => (choice.value = { of: done.value, index });

/** Of the finished picture's pixels, to one of the target. */
export const pieceScale = computed(() => outcome.value?.wood?.scale ?? 1);

export function chooseAt({ x, y }: Point): void {
  const { value: made } = outcome;
  if (!made?.pieces || !grid.value) return;
  choosePiece(pieceAt(made.pieces, grid.value, x * pieceScale.value, y * pieceScale.value));
}

/** Keys of both halves, whatever has the focus in them. */
export function onWoodKey(event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey || !done.value) return;
  const { length } = cuts.value;
  const at = pinned.value;
  const steps: Record<string, number> = {
    n: (at + 1) % length,
    b: (Math.max(at, 0) + length - 1) % length,
    escape: -1,
  };
  const next = steps[event.key.toLowerCase()];
  if (next === undefined) return;
  event.preventDefault();
  choosePiece(next);
}

/** The piece of a panel at a place, mm; -1: none. */
export const cutAt = (panel: string, at: Point): number =>
  cuts.value.findIndex((cut) => cut.panel === panel && isInside(cut.onPanel, at));

export function isInside(ring: readonly number[], { x, y }: Point): boolean {
  let inside = false;
  for (let k = 0, j = ring.length - 2; k < ring.length; j = k, k += 2) {
    const [ax, ay, bx, by] = [ring[k]!, ring[k + 1]!, ring[j]!, ring[j + 1]!];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  }
  return inside;
}
