// Changes of parameters and seed, and their undoing. Whoever calls these says whether to run after.

import type { ParameterValue } from 'tessera-wasm';
import { sameParams, withValue, type Field, type Params } from './form';
import { push, redo as redone, undo as undone } from './history';
import { runSoon } from './runner';
import { isNothing, kNothingDrawn, type Drawn, type PanelFile } from './drawn';
import { edits, fields, kByLabels, kPins, kSegmenter, labels, problems, type Edits } from './store';

/** The parameter that tells what people have corrected in the picture. */
export const kCorrections = 'edits';

/** The control that is being moved or typed into: all it does until it is let go is undone together. */
let moving = '';

function change(key: string, part: Partial<Edits>): boolean {
  const { present } = edits.value;
  const next = { ...present, ...part };
  const { seed, drawn, params } = present;
  if (next.seed === seed && next.drawn === drawn && sameParams(next.params, params)) return false;
  edits.value = push(edits.value, next, key !== '' && key === moving);
  moving = key;
  return true;
}

/** A slider was let go, a field left: what follows is a step of its own. */
export const endStep = () => {
  moving = '';
};

export function changeValue(field: Field, value: ParameterValue): void {
  const { params } = edits.value.present;
  if (change(field.key, { params: withValue(params, field, value) })) runSoon();
}

export function changeSeed(seed: number): void {
  if (change('seed', { seed })) runSoon();
}

/** Many at once, as one step. Does not run. */
export function changeParams(params: Params, seed = edits.value.present.seed): void {
  change('', { params, seed });
}

/** Parameters by key, as one step. */
export function changeValues(values: Params): void {
  let { params } = edits.value.present;
  for (const field of fields.value) {
    const value = values[field.key];
    if (value !== undefined) params = withValue(params, field, value);
  }
  if (change('', { params })) runSoon();
}

export function choosePreset(params: Params): void {
  if (change('', { params })) runSoon();
}

/** `key` names what is being moved, as a field's does. */
export function changeDrawn(part: Partial<Drawn>, key = ''): void {
  if (change(key, { drawn: { ...edits.value.present.drawn, ...part } })) runSoon();
}

/** A picture of densities, or none, with the parameters that make it count; as one step. */
export function changeDensity(density: Drawn['density'], params: Params): void {
  if (change('', { drawn: { ...edits.value.present.drawn, density }, params })) runSoon();
}

/** A file that says what the pieces are, or none, with the parameters that go with it; as one step. */
export function changeShapes(shapes: Drawn['shapes'], params: Params): void {
  if (change('', { drawn: { ...edits.value.present.drawn, shapes }, params })) runSoon();
}

/** Panels of wood, with what is known of them in the parameter "panels"; `key` as above. */
export function changePanels(panels: readonly PanelFile[], options: string, key = ''): void {
  const { drawn, params } = edits.value.present;
  const { panels: _, ...others } = params;
  const next = options ? { ...others, panels: options } : others;
  const same = panels === drawn.panels;
  if (change(key, { drawn: same ? drawn : { ...drawn, panels }, params: next })) runSoon();
}

/** What was drawn belongs to the picture that it was drawn on; wood and other targets do not. Does not run. */
export function dropDrawn(): void {
  const { drawn } = edits.value.present;
  if (!isNothing(drawn)) change('', { drawn: { ...kNothingDrawn, panels: drawn.panels, targets: drawn.targets } });
}

/** The same of what was corrected in it, and of a label picture of it. Does not run. */
export function dropCorrections(): void {
  labels.value = null;
  const { [kCorrections]: corrections, [kPins]: pins, ...others } = edits.value.present.params;
  const { [kSegmenter]: segmenter, ...params } = others;
  change('', { params: segmenter === kByLabels ? params : others });
}

export const undo = () => step(undone(edits.value));
export const redo = () => step(redone(edits.value));

function step(next: typeof edits.value): void {
  if (next === edits.value) return;
  edits.value = next;
  problems.value = {};
  endStep();
  runSoon();
}
