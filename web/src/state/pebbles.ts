// Pebbles that were chosen on their photo, and what is done with them: corrections, which are a parameter like others.

import { computed, signal } from '@preact/signals';
import { gridOf, pieceAt } from '../stage/grid';
import type { Point } from '../stage/view';
import { pixelsPerMetre, withCorrection, type Correction } from './corrections';
import { changeValues, endStep, kCorrections } from './edits';
import { outcome, params } from './store';

export interface Chosen {
  /** Index of the run's pieces. */
  piece: number;
  /** Where it was pressed, px of the photo. */
  at: Point;
}

/** Which half of the stage a narrow window shows. */
export const half = signal<'photo' | 'field' | 'sizes'>('photo');

const pieces = computed(() => outcome.value?.pieces ?? null);
const grid = computed(() => pieces.value && gridOf(pieces.value));
const choice = signal<{ of: unknown; list: readonly Chosen[] }>({ of: null, list: [] });

/** Of the run that is shown; another one forgets them. */
export const chosen = computed(() => (choice.value.of === pieces.value ? choice.value.list : []));
export const corrections = computed(() => String(params.value[kCorrections] ?? ''));

const choose = (list: readonly Chosen[]) => (choice.value = { of: pieces.value, list });

/** The piece at a place of the photo, or -1. */
export const pebbleAt = ({ x, y }: Point): number =>
  pieces.value && grid.value ? pieceAt(pieces.value, grid.value, x, y) : -1;

/** Adds the pebble at a place to those chosen, or takes it out. */
export function toggleAt(at: Point): void {
  const piece = pebbleAt(at);
  if (piece < 0) return;
  const others = chosen.value.filter((one) => one.piece !== piece);
  choose(others.length < chosen.value.length ? others : [...others, { piece, at }]);
}

export const chooseNone = () => choose([]);

/** As a step to undo; the run follows. */
export function correct(what: Correction, places: readonly Point[]): void {
  changeValues({ [kCorrections]: withCorrection(corrections.value, what, places) });
  endStep();
}

export const correctChosen = (what: Correction) =>
  correct(
    what,
    chosen.value.map(({ at }) => at),
  );

export const dropCorrections = () => changeValues({ [kCorrections]: '' });

/** The photo's scale by a line that is so many millimetres long; false where that says nothing. */
export function setScale(from: Point, to: Point, millimetres: number): boolean {
  const pixelsPerM = pixelsPerMetre(from, to, millimetres);
  if (pixelsPerM === null) return false;
  changeValues({ widthM: 0, pixelsPerM });
  endStep();
  return true;
}

/** Whether the photo's size in the world was told at all. */
export const scaleIsKnown = computed(() => Boolean(params.value['widthM'] || params.value['pixelsPerM']));
