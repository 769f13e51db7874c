// The tabs, in order. A technique that the engine does not have yet is shown, and says so.

import type { TechniqueEntry } from './entry';
import { MosaicIcon, ParquetryIcon, PatternIcon, PebblesIcon } from './icons';
import { pavement } from './pavement';

const planned = (name: string, title: string, sentence: string, icon: TechniqueEntry['icon']): TechniqueEntry => ({
  name,
  title,
  sentence,
  icon,
  samples: [],
  presets: [],
  stages: {},
  facts: () => [],
});

export const techniques: readonly TechniqueEntry[] = [
  pavement,
  planned('mosaic', 'Mosaic', 'A decorative mosaic of oriented tiles.', MosaicIcon),
  planned('pebbles', 'Pebbles', 'A photo of gravel as a field of solid pebbles.', PebblesIcon),
  planned('pattern', 'Pattern', 'Random patterns by their mathematics.', PatternIcon),
  planned('parquetry', 'Parquetry', 'A picture cut from real wood.', ParquetryIcon),
];

export const entryOf = (name: string): TechniqueEntry | undefined => techniques.find((t) => t.name === name);
