import type { RunResult } from 'tessera-wasm';
import type { TechniqueEntry } from './entry';
import { counted, percent } from './facts';
import { PebblesIcon } from './icons';
import { presetsOf } from './presets';

const size = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

function facts({ counts, metrics }: RunResult): string[] {
  const { coverage, d50_mm: median } = metrics;
  const words = [counted(counts['pebbles'] ?? 0, 'pebbles')];
  if (coverage !== undefined) words.push(`${percent.format(coverage)} covered`);
  if (median) words.push(`half are finer than ${size.format(median)} mm`);
  return words;
}

export const pebbles: TechniqueEntry = {
  name: 'pebbles',
  title: 'Pebbles',
  sentence: 'A photo of pebbles as a field of solid stones.',
  icon: PebblesIcon,
  pieces: 'pebbles',
  tools: [],
  layers: ['source', 'outlines', 'stones'],
  shown: ['source', 'outlines'],
  solid: true,
  samples: [{ name: 'pebbles', title: 'Riverbed', file: 'pebbles.png', params: { ground: true, groundHole: true } }],
  presets: presetsOf('pebbles'),
  front: ['segmenter', 'smallest', 'contrast', 'widthM', 'heightFactor', 'flatten'],
  without: { segmenter: ['labels'] },
  stages: {
    segment: 'Finding the pebbles',
    outlines: 'Drawing their outlines',
    grains: 'Measuring them',
    meshes: 'Shaping the stones',
  },
  facts,
};
