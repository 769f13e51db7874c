import type { RunResult } from 'tessera-wasm';
import type { Params } from '../state/form';
import type { TechniqueEntry } from './entry';
import { counted } from './facts';
import { PatternIcon } from './icons';

const kLattices = ['checkerboard', 'hexagon', 'triangle'];
const kBombs = ['segments', 'ellipses', 'circles', 'rectangles', 'pixels'];
const kOfPoints = ['occupancy', 'delaunay', 'points', ...kBombs];
const kCells = ['poisson-lines', 'occupancy', 'delaunay', 'johnson-mehl', ...kLattices];

/** Which models a parameter is for; of every model where it is not here. */
const kModels: Readonly<Record<string, readonly string[]>> = {
  size: [...kCells, 'points', ...kBombs],
  intensity: ['poisson-lines', 'johnson-mehl', ...kOfPoints],
  probabilities: [...kCells, 'gaussian'],
  variation: [...kCells, 'points', ...kBombs],
  border: kCells,
  borderColor: [...kCells, 'points', ...kBombs],
  process: kOfPoints,
  speed: ['johnson-mehl'],
  length: ['segments', 'ellipses', 'circles', 'rectangles'],
  breadth: ['ellipses', 'rectangles'],
  sizeVariation: ['segments', 'ellipses', 'circles', 'rectangles'],
  correlation: ['gaussian'],
  dot: ['points', 'segments'],
};

/** The same of point processes. */
const kProcesses: Readonly<Record<string, readonly string[]>> = {
  family: ['cluster'],
  spread: ['cluster'],
  inhibition: ['matern-1', 'matern-2'],
  mixing: ['mixed'],
  fieldScale: ['cox'],
  fieldDeviation: ['cox'],
  grid: ['binomial'],
};

const modelOf = ({ model = 'occupancy' }: Params) => String(model);

/** Whether the parameter changes anything about a pattern of the model and process that are chosen. */
function matters(key: string, params: Params): boolean {
  const model = modelOf(params);
  const { process = 'poisson', variation = 'none', border = 0 } = params;
  if (kProcesses[key]) return kOfPoints.includes(model) && kProcesses[key].includes(String(process));
  if (kModels[key] && !kModels[key].includes(model)) return false;
  if (key === 'covariance') return model === 'gaussian' || variation !== 'none';
  if (key === 'borderColor' && kCells.includes(model)) return Number(border) > 0;
  return true;
}

/** Bombs and points have a colour, and their ground another. */
function colourNames(params: Params): readonly string[] | null {
  const model = modelOf(params);
  if (model === 'points') return ['Points', 'Ground'];
  return kBombs.includes(model) ? ['Bombs', 'Ground'] : null;
}

/** Bombs lie over each other, and noise is all pixels: their picture tells what they are like. */
const measurable = (params: Params) => ([...kCells, 'points'].includes(modelOf(params)) ? 'svg' : 'png');

/** With points for it to tell of. */
const forDensity = (params: Params): Params =>
  kOfPoints.includes(modelOf(params)) ? params : { ...params, model: 'points', size: 8 };

function facts({ counts, metrics }: RunResult): string[] {
  const [layer = 'cells', count = 0] = Object.entries(counts)[0] ?? [];
  const { area_mean: area } = metrics;
  return area && layer === 'cells'
    ? [counted(count, layer), `${size.format(area)} px² on average`]
    : [counted(count, layer)];
}

const size = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

export const pattern: TechniqueEntry = {
  name: 'pattern',
  title: 'Pattern',
  sentence: 'Random patterns by their mathematics.',
  icon: PatternIcon,
  pieces: 'pieces',
  tools: [],
  layers: ['outlines', 'stones'],
  shown: ['stones'],
  solid: false,
  samples: [],
  presets: [],
  pictured: 'model',
  titles: { 'johnson-mehl': 'Johnson-Mehl' },
  matters,
  colourNames,
  forDensity,
  measurable,
  front: ['size', 'length', 'breadth', 'width', 'height', 'colors', 'variation', 'border', 'seamless'],
  stages: { cells: 'Laying out the cells', colours: 'Colouring them' },
  facts,
};
