// The numbers of a report on statistics, in rows for people.

import type { Measured } from 'tessera-wasm';

export interface Figure {
  title: string;
  measured: string;
  /** By the closed form; empty where there is none. */
  expected: string;
  /** Of a colour's row. */
  colour?: string;
}

interface Moment {
  mean: number;
  error: number;
  expected?: number;
}

const plain = new Intl.NumberFormat('en', { maximumSignificantDigits: 4 });
const count = new Intl.NumberFormat('en');
const percent = new Intl.NumberFormat('en', { style: 'percent', maximumFractionDigits: 1 });
const kThousand = 1000; // px²

const optional = (value: unknown) => (typeof value === 'number' && value > 0 ? plain.format(value) : '');

const kExact = 1e-4; // of the value; a smaller error is that of the file's digits

/** "5.99 ± 0.06": as many digits as the error leaves. */
export function withError({ mean, error }: { mean: number; error: number }): string {
  if (!(error > kExact * Math.abs(mean))) return plain.format(mean);
  const digits = Math.min(20, Math.max(0, 1 - Math.floor(Math.log10(error))));
  const format = new Intl.NumberFormat('en', { minimumFractionDigits: digits, maximumFractionDigits: digits });
  return `${format.format(mean)} ± ${format.format(error)}`;
}

type Report = Measured['report'];

const kOf: Readonly<Record<Report['kind'], (report: Report) => Figure[]>> = {
  cells: ofCells,
  points: ofPoints,
  picture: ofPicture,
};

export const figuresOf = (report: Report): Figure[] => kOf[report.kind](report);

function ofCells(report: Report): Figure[] {
  const row = (title: string, key: string): Figure => {
    const moment = report[key] as Moment;
    return { title, measured: withError(moment), expected: optional(moment.expected) };
  };
  return [
    {
      title: 'Cells in 1,000 px²',
      measured: plain.format(Number(report['cells_per_area']) * kThousand),
      expected: optional(Number(report['expected_cells_per_area']) * kThousand),
    },
    row('Area, px²', 'area'),
    row('Perimeter, px', 'perimeter'),
    row('Sides', 'sides'),
  ];
}

function ofPoints(report: Report): Figure[] {
  return [
    { title: 'Points', measured: count.format(Number(report['points'])), expected: '' },
    { title: 'Points in 1,000 px²', measured: plain.format(Number(report['intensity']) * kThousand), expected: '' },
    {
      title: 'Nearest neighbour, px',
      measured: plain.format(Number(report['nearest_mean'])),
      expected: optional(report['nearest_poisson']),
    },
  ];
}

const kMostColours = 6;

function ofPicture(report: Report): Figure[] {
  const classes = report['classes'] as { colour: string; share: number; patch_width_px: number }[];
  return classes.slice(0, kMostColours).map(({ colour, share, patch_width_px: width }) => ({
    title: colour,
    colour,
    measured: `${percent.format(share)}, ${plain.format(width)} px wide`,
    expected: '',
  }));
}
