// Changes of parameters and seed, and their undoing. Whoever calls these says whether to run after.

import type { ParameterValue } from 'tessera-wasm';
import { sameParams, withValue, type Field, type Params } from './form';
import { push, redo as redone, undo as undone } from './history';
import { runSoon } from './runner';
import { edits, problems } from './store';

const kOneDrag = 900; // ms between steps of a slider that are undone together
let last = { key: '', at: 0 };

function change(key: string, next: { params: Params; seed: number }): boolean {
  const { present } = edits.value;
  if (next.seed === present.seed && sameParams(next.params, present.params)) return false;
  const now = performance.now();
  edits.value = push(edits.value, next, key === last.key && now - last.at < kOneDrag);
  last = { key, at: now };
  return true;
}

export function changeValue(field: Field, value: ParameterValue): void {
  const { params, seed } = edits.value.present;
  if (change(field.key, { params: withValue(params, field, value), seed })) runSoon();
}

export function changeSeed(seed: number): void {
  if (change('seed', { params: edits.value.present.params, seed })) runSoon();
}

/** Many at once, as one step. Does not run. */
export function changeParams(params: Params, seed = edits.value.present.seed): void {
  change('', { params, seed });
}

export function choosePreset(params: Params): void {
  if (change('', { params, seed: edits.value.present.seed })) runSoon();
}

export const undo = () => step(undone(edits.value));
export const redo = () => step(redone(edits.value));

function step(next: typeof edits.value): void {
  if (next === edits.value) return;
  edits.value = next;
  problems.value = {};
  last = { key: '', at: 0 };
  runSoon();
}
