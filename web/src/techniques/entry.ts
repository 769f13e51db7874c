import type { RunResult } from 'tessera-wasm';
import type { ComponentType } from 'preact';
import type { Params } from '../state/form';
import type { Layer, Measurable } from '../worker/protocol';

export interface Sample {
  name: string;
  title: string;
  /** In samples/; a reduced one of the same name is in samples/thumbnails/. */
  file: string;
  /** Parameters that this picture wants. */
  params?: Params;
}

/** What else than a file makes a picture, or is drawn over it; what the pointer does on the stage then. */
export type PictureTool = 'sketch' | 'word' | 'guides' | 'regions' | 'grid' | 'edges';
export type Tool = PictureTool | PebbleTool;

/** What corrects pebbles on their photo. */
export type PebbleTool = 'pick' | 'split' | 'add' | 'ruler';

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
  /** Of those beside the picture's file. */
  tools: readonly PictureTool[];
  /** Whether its tools have anything to do, as the parameters are; they do where this is missing. */
  usesTools?(params: Params): boolean;
  /** What the stage can show of it, and what it shows at first. */
  layers: readonly Layer[];
  shown: readonly Layer[];
  /** Its pieces are solid: a view of them stands beside the picture, which it searches in a size of its own. */
  solid: boolean;
  /** Parameters that are not folded away, where the engine's word on that is not this page's. */
  front?: readonly string[];
  /** A choice that is made by its pictures, in models/. */
  pictured?: string;
  /** What people call a value of it, where that is not the value itself. */
  titles?: Readonly<Record<string, string>>;
  /** Whether a parameter changes anything, as the others are; all do where this is missing. */
  matters?(key: string, params: Params): boolean;
  /** What the first colours of a list are for, and no others are used; null where all are alike. */
  colourNames?(params: Params): readonly string[] | null;
  /** Parameters with which a picture of densities tells something. */
  forDensity?(params: Params): Params;
  /** Choices of parameters that need what a page does not have. */
  without?: Readonly<Record<string, readonly string[]>>;
  /** From which of its files statistics are taken; none are where this is missing. */
  measurable?(params: Params): Measurable;
  /** It is cut from panels of wood; these, of samples/panels/, are there to begin with. */
  panels?: readonly { name: string; file: string }[];
  /** What its picture is called where that is chosen; "Image" where this is missing. */
  pictureTitle?: string;
  samples: readonly Sample[];
  presets: readonly Preset[];
  /** What the engine's stages are called while they go on. */
  stages: Readonly<Record<string, string>>;
  /** A finished run in a few words: "16,385 stones". */
  facts(result: RunResult): string[];
}
