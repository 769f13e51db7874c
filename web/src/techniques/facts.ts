// Words and figures for what came of a run.

const number = new Intl.NumberFormat('en');

export const percent = new Intl.NumberFormat('en', { style: 'percent', maximumFractionDigits: 1 });

/** "16,385 stones", "1 stone". */
export const counted = (count: number, pieces: string) =>
  `${number.format(count)} ${count === 1 ? pieces.replace(/s$/, '') : pieces}`;
