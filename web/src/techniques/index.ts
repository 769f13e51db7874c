// The tabs, in order. A technique that the engine does not have yet is shown, and says so.

import type { TechniqueEntry } from './entry';
import { ParquetryIcon, PatternIcon, PebblesIcon } from './icons';
import { mosaic } from './mosaic';
import { pavement } from './pavement';

const planned = (name: string, title: string, sentence: string, icon: TechniqueEntry['icon']): TechniqueEntry => ({
  name,
  title,
  sentence,
  icon,
  pieces: 'pieces',
  tools: [],
  layers: [],
  samples: [],
  presets: [],
  stages: {},
  facts: () => [],
});

export const techniques: readonly TechniqueEntry[] = [
  pavement,
  mosaic,
  planned('pebbles', 'Pebbles', 'A photo of gravel as a field of solid pebbles.', PebblesIcon),
  planned('pattern', 'Pattern', 'Random patterns by their mathematics.', PatternIcon),
  planned('parquetry', 'Parquetry', 'A picture cut from real wood.', ParquetryIcon),
];

export const entryOf = (name: string): TechniqueEntry | undefined => techniques.find((t) => t.name === name);
