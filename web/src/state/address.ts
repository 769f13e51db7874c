// Keeps the address bar and the state alike.

import { effect } from '@preact/signals';
import { schema } from 'tessera-wasm/description';
import { entryOf } from '../techniques/index';
import { changeParams } from './edits';
import { parseValue, type Params } from './form';
import { readHash, writeHash, type Address } from './hash';
import { sampleNamed, useSample } from './pictures';
import { generate, runSoon } from './runner';
import { alertWith, edits, entry, fields, freshEdits, inputRole, params, picture, seed, technique } from './store';
import { switchTo } from './tabs';

const kPause = 250; // ms; browsers refuse a page that writes the address at every step of a slider

/** The job that the address names, or the first sample with all defaults; without a picture what the parameters say. */
export async function openAddress(): Promise<void> {
  const address = readHash(location.hash);
  followTechnique(address);
  const { known, foreign } = paramsOf(address);
  const sample = sampleNamed(address.sample) ?? entry.value.samples[0];
  const fresh = location.hash === '';
  edits.value = freshEdits(fresh ? (sample?.params ?? {}) : known, address.seed ?? 1);
  if (sample) await useSample(sample, true);
  else if (!inputRole.value) generate();
  if (foreign.length) alertWith(`The address has ${foreign.join(', ')}, which cannot be used here and was left out.`);
}

function followTechnique({ technique: name }: Address): void {
  if (name && entryOf(name) && schema.$defs[name]) switchTo(name);
}

function paramsOf(address: Address): { known: Params; foreign: string[] } {
  const known: Record<string, Params[string]> = {};
  const foreign: string[] = [];
  for (const [key, text] of Object.entries(address.params)) {
    const field = fields.value.find((f) => f.key === key);
    const value = field && parseValue(field, text);
    if (value === undefined) foreign.push(`“${key}=${text}”`);
    else known[key] = value;
  }
  return { known, foreign };
}

/** Follows changes from now on, both ways. */
export function bindAddress(): void {
  let timer = 0;
  effect(() => {
    const sample = inputRole.value ? (picture.value?.sample ?? null) : null;
    const hash = writeHash(technique.value, seed.value, sample, params.value);
    clearTimeout(timer);
    timer = window.setTimeout(() => history.replaceState(null, '', hash), kPause);
  });
  addEventListener('hashchange', () => {
    const address = readHash(location.hash);
    followTechnique(address);
    const { known, foreign } = paramsOf(address);
    const sample = sampleNamed(address.sample) ?? (picture.value ? undefined : entry.value.samples[0]);
    changeParams(known, address.seed ?? 1);
    if (sample && sample.name !== picture.value?.sample) void useSample(sample, true);
    else runSoon();
    if (foreign.length)
      alertWith(`The address has ${foreign.join(', ')}, which cannot be used here and was left out.`);
  });
}
