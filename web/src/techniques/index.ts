// The tabs, in order. A technique that the engine does not have yet is shown, and says so.

import type { TechniqueEntry } from './entry';
import { ParquetryIcon } from './icons';
import { mosaic } from './mosaic';
import { pattern } from './pattern';
import { pavement } from './pavement';
import { pebbles } from './pebbles';

const planned = (name: string, title: string, sentence: string, icon: TechniqueEntry['icon']): TechniqueEntry => ({
  name,
  title,
  sentence,
  icon,
  pieces: 'pieces',
  tools: [],
  layers: [],
  shown: [],
  solid: false,
  samples: [],
  presets: [],
  stages: {},
  facts: () => [],
});

export const techniques: readonly TechniqueEntry[] = [
  pavement,
  mosaic,
  pebbles,
  pattern,
  planned('parquetry', 'Parquetry', 'A picture cut from real wood.', ParquetryIcon),
];

export const entryOf = (name: string): TechniqueEntry | undefined => techniques.find((t) => t.name === name);
