import type { RunResult } from 'tessera-wasm';
import type { ComponentType } from 'preact';
import type { Params } from '../state/form';
import type { Layer } from '../worker/protocol';

export interface Sample {
  name: string;
  title: string;
  /** Below the page's address. */
  file: string;
  /** Parameters that this picture wants. */
  params?: Params;
}

/** What else than a file makes a picture, or is drawn over it. */
export type Tool = 'sketch' | 'word' | 'guides' | 'regions';

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
  /** What its pieces are: "stones". */
  pieces: string;
  tools: readonly Tool[];
  /** What the stage can show of it. */
  layers: readonly Layer[];
  samples: readonly Sample[];
  presets: readonly Preset[];
  /** What the engine's stages are called while they go on. */
  stages: Readonly<Record<string, string>>;
  /** A finished run in a few words: "16,385 stones". */
  facts(result: RunResult): string[];
}
