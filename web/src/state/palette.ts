// The mosaic's palette as people write it: nothing, a number, or "chalk #f4f1e8, brick #8c4a32". The engine's reading of
// it is core/mosaic/tile_palette.cpp.

export interface Tile {
  name: string; // may be empty
  colour: string; // "#f4f1e8"
}

export type Palette = { kind: 'own' } | { kind: 'number'; count: number } | { kind: 'list'; tiles: readonly Tile[] };

export const kMostColours = 256; // of a number

/** To start a list from. */
export const kUsualTiles: readonly Tile[] = [
  { name: 'chalk', colour: '#f4f1e8' },
  { name: 'sand', colour: '#d9c29a' },
  { name: 'ochre', colour: '#c8923e' },
  { name: 'brick', colour: '#8c4a32' },
  { name: 'rose', colour: '#c98a83' },
  { name: 'olive', colour: '#6b7340' },
  { name: 'leaf', colour: '#a3b263' },
  { name: 'sea', colour: '#3f6f8a' },
  { name: 'sky', colour: '#a9c6d6' },
  { name: 'slate', colour: '#5b6068' },
  { name: 'basalt', colour: '#26262a' },
];

export function parsePalette(text: string): Palette {
  const words = text.trim();
  if (/^\d{1,3}$/.test(words)) return { kind: 'number', count: Number(words) };
  const tiles = readTiles(text);
  return tiles.length ? { kind: 'list', tiles } : { kind: 'own' };
}

export function paletteText(palette: Palette): string {
  if (palette.kind === 'own') return '';
  if (palette.kind === 'number') return String(palette.count);
  return palette.tiles.map(({ name, colour }) => `${cleanName(name)} ${colour}`.trim()).join(', ');
}

/** Without what would end an entry or begin a colour. */
export const cleanName = (name: string): string => name.replace(/[,;#\s]+/g, ' ').trim();

const kColour = /#([0-9a-f]{6}|[0-9a-f]{3})(?![0-9a-f])|(?<!\d)(\d{1,3})[\s,;/]+(\d{1,3})[\s,;/]+(\d{1,3})(?!\d)/gi;

/** Colours from a pasted list or table: "#f4f1e8" or "244, 241, 232", each with what is written before it, or else after. */
export function readTiles(text: string): Tile[] {
  return text.split(/[\n\r]+/).flatMap((line) => {
    const found = [...line.matchAll(kColour)];
    const colours = found
      .map((match) => ({ match, colour: colourOf(match) }))
      .filter(({ colour }) => colour !== null);
    return colours.map(({ match, colour }, i) => {
      const before = colours[i - 1]?.match;
      const name = nameIn(line.slice(before ? before.index + before[0].length : 0, match.index));
      const after = colours.length === 1 ? nameIn(line.slice(match.index + match[0].length)) : '';
      return { name: name || after, colour: colour ?? '' };
    });
  });
}

const nameIn = (text: string) =>
  cleanName(text.replace(/["'()|:=\t]|\brgb\b/gi, ' ').replace(/(^|\s)-+(?=\s|$)/g, ' '));

function colourOf([, hex, ...triple]: RegExpMatchArray): string | null {
  if (hex) return `#${hex.length === 3 ? [...hex].map((c) => c + c).join('') : hex}`.toLowerCase();
  const parts = triple.map(Number);
  if (parts.some((part) => part > 255)) return null;
  return `#${parts.map((part) => part.toString(16).padStart(2, '0')).join('')}`;
}
