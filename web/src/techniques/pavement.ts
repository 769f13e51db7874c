import type { RunResult } from 'tessera-wasm';
import type { TechniqueEntry } from './entry';
import { PavementIcon } from './icons';

const number = new Intl.NumberFormat('en');
const percent = new Intl.NumberFormat('en', { style: 'percent', maximumFractionDigits: 1 });

function facts({ counts, metrics }: RunResult): string[] {
  const stones = counts['stones'] ?? 0;
  const quads = metrics['quad_fraction'];
  const words = [`${number.format(stones)} ${stones === 1 ? 'stone' : 'stones'}`];
  if (quads !== undefined) words.push(`${percent.format(quads)} four corners`);
  return words;
}

export const pavement: TechniqueEntry = {
  name: 'pavement',
  title: 'Pavement',
  sentence: 'Drawings laid in Portuguese paving stones.',
  icon: PavementIcon,
  samples: [
    { name: 'waves', title: 'Waves', file: 'samples/waves.png' },
    { name: 'ornament', title: 'Ornament', file: 'samples/ornament.png' },
    { name: 'lettering', title: 'Lettering', file: 'samples/lettering.png' },
    { name: 'tiles', title: 'Tiles', file: 'samples/tiles.png', params: { colors: 4 } },
  ],
  presets: [
    { title: 'Copacabana', hint: 'Lively stones of mixed length', picture: 'presets/copacabana.png', params: {} },
    {
      title: 'Lisbon',
      hint: 'Near-square stones, settled evenly',
      picture: 'presets/lisbon.png',
      params: { halfSide: 5, stretchMin: 0.9, stretchMax: 1.15, grout: 0.8, iterations: 40 },
    },
    {
      title: 'Coarse',
      hint: 'Large stones, wide grout',
      picture: 'presets/coarse.png',
      params: { halfSide: 9, grout: 1.6, stretchMin: 0.7, stretchMax: 1.6 },
    },
    {
      title: 'Fine',
      hint: 'Small stones, thin grout',
      picture: 'presets/fine.png',
      params: { halfSide: 2.5, grout: 0.3 },
    },
  ],
  stages: { fields: 'Reading the drawing', diagram: 'Settling the stones', stones: 'Cutting the stones' },
  facts,
};
