// A list of colours as people write it, "#b5533c #e4dbcb", and the shares that may go with it, "0.5 0.3 0.2". The
// engine's reading of them is core/patterns/colours.cpp.

export interface ColourList {
  /** "#b5533c" */
  colours: readonly string[];
  /** One a colour, or none: all alike. */
  shares: readonly number[];
}

export const kMostColours = 256;

const wordsOf = (text: string) => text.split(/[\s,;]+/).filter(Boolean);

/** Null where the texts say something else: what a person is still typing, say. */
export function readColours(colours: string, shares: string): ColourList | null {
  const list = { colours: wordsOf(colours).map(longForm), shares: wordsOf(shares).map(Number) };
  if (list.colours.length === 0 || !list.colours.every((colour) => /^#[0-9a-f]{6}$/.test(colour))) return null;
  if (list.shares.length !== 0 && list.shares.length !== list.colours.length) return null;
  return list.shares.every((share) => share > 0 && Number.isFinite(share)) ? list : null;
}

function longForm(word: string): string {
  const [, ...digits] = word.toLowerCase();
  return word.length === 4 ? `#${digits.map((digit) => digit + digit).join('')}` : word.toLowerCase();
}

export const coloursText = ({ colours }: ColourList) => colours.join(' ');
export const sharesText = ({ shares }: ColourList) => shares.join(' ');

export const withColour = ({ colours, shares }: ColourList, at: number, colour: string): ColourList => ({
  colours: colours.map((old, i) => (i === at ? colour : old)),
  shares,
});

export const withoutColour = ({ colours, shares }: ColourList, at: number): ColourList => ({
  colours: colours.filter((_, i) => i !== at),
  shares: shares.filter((_, i) => i !== at),
});

/** One more at the end, with the mean of the others' shares. */
export const withNewColour = ({ colours, shares }: ColourList, colour: string): ColourList => ({
  colours: [...colours, colour],
  shares: shares.length ? [...shares, Number((sum(shares) / shares.length).toPrecision(3))] : shares,
});

/** Parts of the whole, one a colour. */
export const partsOf = ({ colours, shares }: ColourList): number[] =>
  colours.map((_, i) => (shares.length ? shares[i]! / sum(shares) : 1 / colours.length));

const sum = (numbers: readonly number[]) => numbers.reduce((a, b) => a + b, 0);
