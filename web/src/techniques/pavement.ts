import type { RunResult } from 'tessera-wasm';
import { kLayers } from '../worker/protocol';
import type { TechniqueEntry } from './entry';
import { counted, percent } from './facts';
import { PavementIcon } from './icons';
import { presetsOf } from './presets';

function facts({ counts, metrics }: RunResult): string[] {
  const quads = metrics['quad_fraction'];
  const words = [counted(counts['stones'] ?? 0, 'stones')];
  if (quads !== undefined) words.push(`${percent.format(quads)} four corners`);
  return words;
}

export const pavement: TechniqueEntry = {
  name: 'pavement',
  title: 'Pavement',
  sentence: 'Drawings laid in Portuguese paving stones.',
  icon: PavementIcon,
  pieces: 'stones',
  tools: ['sketch', 'word'],
  layers: kLayers.filter((layer) => layer !== 'outlines'),
  shown: ['stones'],
  solid: false,
  samples: [
    { name: 'waves', title: 'Waves', file: 'waves.png' },
    { name: 'ornament', title: 'Ornament', file: 'ornament.png' },
    { name: 'lettering', title: 'Lettering', file: 'lettering.png' },
    { name: 'tiles', title: 'Tiles', file: 'tiles.png', params: { colors: 4 } },
  ],
  presets: presetsOf('pavement'),
  stages: { fields: 'Reading the drawing', diagram: 'Settling the stones', stones: 'Cutting the stones' },
  facts,
};
