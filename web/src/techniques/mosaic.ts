import type { RunResult } from 'tessera-wasm';
import type { TechniqueEntry } from './entry';
import { counted, percent } from './facts';
import { MosaicIcon } from './icons';
import { presetsOf } from './presets';

function facts({ counts, metrics }: RunResult): string[] {
  const covered = metrics['coverage'];
  const words = [counted(counts['tiles'] ?? 0, 'tiles')];
  if (covered !== undefined) words.push(`${percent.format(covered)} covered`);
  return words;
}

export const mosaic: TechniqueEntry = {
  name: 'mosaic',
  title: 'Mosaic',
  sentence: 'Photos laid in tiles that follow their contours.',
  icon: MosaicIcon,
  pieces: 'tiles',
  tools: ['guides', 'regions'],
  layers: ['source', 'direction', 'sites', 'cells', 'stones'],
  shown: ['stones'],
  solid: false,
  samples: [
    { name: 'fruit', title: 'Fruit', file: 'fruit.png' },
    { name: 'coast', title: 'Coast', file: 'coast.png' },
  ],
  presets: presetsOf('mosaic'),
  stages: {
    fields: 'Finding the contours',
    sites: 'Placing rows of tiles',
    diagram: 'Settling the tiles',
    tiles: 'Cutting the tiles',
  },
  facts,
};
