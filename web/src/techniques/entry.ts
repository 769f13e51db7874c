import type { RunResult } from 'tessera-wasm';
import type { ComponentType } from 'preact';
import type { Params } from '../state/form';

export interface Sample {
  name: string;
  title: string;
  /** Below the page's address. */
  file: string;
  /** Parameters that this picture wants. */
  params?: Params;
}

export interface Preset {
  title: string;
  hint: string;
  picture: string;
  params: Params;
}

/** What the page says about a technique. Whether it is there, its parameters and files, the engine's schema says. */
export interface TechniqueEntry {
  name: string; // "pavement", as jobs have it
  title: string;
  sentence: string;
  icon: ComponentType;
  samples: readonly Sample[];
  presets: readonly Preset[];
  /** What the engine's stages are called while they go on. */
  stages: Readonly<Record<string, string>>;
  /** A finished run in a few words: "16,385 stones". */
  facts(result: RunResult): string[];
}
