import type { RunResult } from 'tessera-wasm';
import type { TechniqueEntry } from './entry';
import { counted, percent } from './facts';
import { ParquetryIcon } from './icons';

const number = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

function facts({ counts, metrics }: RunResult): string[] {
  const words = [counted(counts['pieces'] ?? 0, 'pieces')];
  if (counts['targets']) words.push(counted(counts['targets'], 'targets'));
  const { wood_used: used, cost_per_px: cost, cut_mm: cut } = metrics;
  if (counts['missing']) words.push(`${number.format(counts['missing'])} without wood`);
  if (used !== undefined) words.push(`${percent.format(used)} of the wood`);
  if (cost !== undefined) words.push(`cost ${number.format(cost)} a pixel`);
  if (cut) words.push(`${number.format(cut / 1000)} m to cut`);
  return words;
}

/** Few pieces and pixels, so that the first visit sees them all within seconds. */
const kSmall = { imageSizeMm: 100, patchMm: 8, rotations: 8, resolutionDpi: 75 };

export const parquetry: TechniqueEntry = {
  name: 'parquetry',
  title: 'Parquetry',
  sentence: 'A picture cut from real wood.',
  icon: ParquetryIcon,
  pieces: 'pieces',
  tools: ['grid', 'edges'],
  usesTools: ({ grid, posterize }) => grid === 'morphed' && !posterize,
  layers: ['source', 'outlines', 'stones'],
  shown: ['stones'],
  solid: false,
  panels: [{ name: 'walnut', file: 'walnut.png' }],
  pictureTitle: 'Target',
  samples: [
    { name: 'coast', title: 'Coast', file: 'coast.png', params: kSmall },
    { name: 'fruit', title: 'Fruit', file: 'fruit.png', params: kSmall },
  ],
  presets: [],
  front: ['imageSizeMm', 'patchMm', 'grid', 'rotations', 'order', 'kerfMm'],
  /** Set beside the panels themselves. */
  matters: (key) => key !== 'panels',
  stages: {
    panels: 'Looking at the wood',
    patches: 'Cutting the picture up',
    features: 'Looking at its grain',
    matching: 'Choosing wood for each piece',
    improving: 'Exchanging wood',
    format: 'Drawing the cuts',
  },
  facts,
};
