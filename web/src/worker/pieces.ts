// Pieces as flat arrays, which cross between threads without a copy, from the engine's GeoJSON.

import type { ColourCount } from './protocol';

export interface Pieces {
  /** Of the picture, px. */
  width: number;
  height: number;
  count: number;
  /** "stone". */
  kind: string;
  /** The number in a piece's name: 17 of "stone-17". */
  ids: Uint32Array;
  /** Piece i has the rings from pieceStarts[i] to pieceStarts[i + 1]; ring r the points from ringStarts[r] on. */
  pieceStarts: Uint32Array;
  ringStarts: Uint32Array;
  /** x, y. */
  points: Float32Array;
  palette: string[];
  /** Index into palette. */
  colours: Uint32Array;
  areas: Float32Array;
  vertices: Uint16Array;
  /** Degrees, 0 to 180, x towards y. */
  orientations: Float32Array;
  /** What a technique tells of its pieces besides, a number for each: "b_mm". */
  columns: Readonly<Record<string, Float32Array>>;
}

interface Feature {
  properties: { id: string; colour: string; area: number; vertices: number; orientation: number } & Readonly<
    Record<string, unknown>
  >;
  geometry: { type: 'Polygon'; coordinates: Ring[] } | { type: 'Point'; coordinates: Place };
}

type Place = [number, number];
type Ring = Place[];

const kNewline = 10;
/** Of every sheet; the others are the technique's. */
const kCommon = new Set(['id', 'colour', 'area', 'vertices', 'orientation', 'centroid']);

/**
 * The writer puts each Feature on a line of its own; read line by line, a large sheet needs a fraction of the memory
 * that one JSON.parse takes.
 */
export function parsePieces(json: Uint8Array): Pieces {
  const utf8 = new TextDecoder();
  const features: Feature[] = [];
  let bbox: number[] = [];
  for (let start = 0; start < json.length;) {
    const found = json.indexOf(kNewline, start);
    const end = found < 0 ? json.length : found;
    const line = utf8.decode(json.subarray(start, end)).replace(/,$/, '');
    if (line.startsWith('{"type":"Feature",')) features.push(JSON.parse(line) as Feature);
    else if (start === 0) bbox = JSON.parse(line + ']}').bbox ?? [];
    start = end + 1;
  }
  return packPieces(features, bbox[2] ?? 0, bbox[3] ?? 0);
}

/** A sheet whose pieces nobody looks at one by one. */
export const noPieces = (width: number, height: number): Pieces => packPieces([], width, height);

function packPieces(features: readonly Feature[], width: number, height: number): Pieces {
  const count = features.length;
  const outlines = features.map(outlineOf);
  const rings = outlines.reduce((sum, outline) => sum + outline.length, 0);
  const points = outlines.reduce((sum, outline) => outline.reduce((s, r) => s + r.length - 1, sum), 0);
  const palette = new Map<string, number>();
  const pieces: Pieces = {
    width,
    height,
    count,
    kind: features[0]?.properties.id.replace(/-\d+$/, '') ?? 'piece',
    ids: new Uint32Array(count),
    pieceStarts: new Uint32Array(count + 1),
    ringStarts: new Uint32Array(rings + 1),
    points: new Float32Array(2 * points),
    palette: [],
    colours: new Uint32Array(count),
    areas: new Float32Array(count),
    vertices: new Uint16Array(count),
    orientations: new Float32Array(count),
    columns: columnsOf(features),
  };
  let ring = 0;
  let point = 0;
  features.forEach(({ properties }, i) => {
    pieces.ids[i] = Number(properties.id.slice(pieces.kind.length + 1));
    if (!palette.has(properties.colour)) palette.set(properties.colour, palette.size);
    pieces.colours[i] = palette.get(properties.colour) ?? 0;
    pieces.areas[i] = properties.area;
    pieces.vertices[i] = properties.vertices;
    pieces.orientations[i] = properties.orientation;
    for (const coordinates of outlines[i]!) {
      // GeoJSON repeats a ring's first point at its end.
      for (const [x, y] of coordinates.slice(0, -1)) {
        pieces.points[2 * point] = x;
        pieces.points[2 * point + 1] = y;
        ++point;
      }
      pieces.ringStarts[++ring] = point;
    }
    pieces.pieceStarts[i + 1] = ring;
  });
  pieces.palette = [...palette.keys()];
  return pieces;
}

const kDotCorners = 16;

/** Rings, which repeat their first place at their end. A point is drawn as a dot of its area. */
function outlineOf({ geometry, properties }: Feature): Ring[] {
  if (geometry.type === 'Polygon') return geometry.coordinates;
  const [x, y] = geometry.coordinates;
  const radius = Math.sqrt(properties.area / Math.PI);
  const corner = (k: number): Place => {
    const angle = (2 * Math.PI * k) / kDotCorners;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  };
  return [Array.from({ length: kDotCorners + 1 }, (_, k) => corner(k))];
}

function columnsOf(features: readonly Feature[]): Record<string, Float32Array> {
  const names = Object.keys(features[0]?.properties ?? {}).filter((name) => !kCommon.has(name));
  return Object.fromEntries(
    names.map((name) => [name, Float32Array.from(features, ({ properties }) => Number(properties[name]))]),
  );
}

/** How many pieces have each colour, the most first. */
export function countColours({ palette, colours }: Pick<Pieces, 'palette' | 'colours'>): ColourCount[] {
  const counts = palette.map((colour) => ({ colour, count: 0 }));
  for (const index of colours) ++counts[index]!.count;
  return counts.sort((a, b) => b.count - a.count);
}

export const transferable = (pieces: Pieces): Transferable[] =>
  [...Object.values(pieces), ...Object.values(pieces.columns)].flatMap((value) =>
    ArrayBuffer.isView(value) ? [value.buffer as ArrayBuffer] : [],
  );
