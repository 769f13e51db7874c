// The address bar's part after #: technique, seed, sample, and the parameters that differ from their defaults.

import type { ParameterValue } from 'tessera-wasm';

export interface Address {
  technique: string | null;
  seed: number | null;
  sample: string | null;
  /** As text: which type a parameter has is known only once the engine is there. */
  params: Record<string, string>;
}

const kOwn = new Set(['technique', 'seed', 'sample']);
const kMaxSeed = Number.MAX_SAFE_INTEGER;

export function readHash(hash: string): Address {
  const words = new URLSearchParams(hash.replace(/^#/, ''));
  const params: Record<string, string> = {};
  for (const [key, value] of words) if (!kOwn.has(key)) params[key] = value;
  return { technique: words.get('technique'), seed: seedOf(words.get('seed')), sample: words.get('sample'), params };
}

export function writeHash(
  technique: string,
  seed: number,
  sample: string | null,
  params: Readonly<Record<string, ParameterValue>>,
): string {
  const words = new URLSearchParams({ technique, seed: String(seed) });
  if (sample) words.set('sample', sample);
  for (const [key, value] of Object.entries(params)) words.set(key, String(value));
  return `#${words}`;
}

/** A seed that JSON carries unharmed, or null. */
export function seedOf(text: string | null): number | null {
  if (text === null || !/^\d+$/.test(text.trim())) return null;
  const seed = Number(text);
  return seed <= kMaxSeed ? seed : null;
}
