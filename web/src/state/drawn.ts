// What a job takes besides its picture: guide curves, regions of tile sizes and which edges count, drawn over it; pictures
// of densities or of pieces.

import { smoothPath } from '../stage/curve';
import type { Point, Size } from '../stage/view';
import { kEdgeMask, kLabels } from '../worker/protocol';
import { drawStroke, type Context2D, type Stroke } from './strokes';

/** The points that a smooth curve goes through, px of the picture. */
export type Guide = readonly Point[];

/** A scan of wood, and where on it there is wood. */
export interface PanelFile {
  /** What its files are called. */
  readonly name: string;
  readonly file: string;
  readonly blob: Blob;
  readonly mask: { readonly file: string; readonly blob: Blob } | null;
  /** That correct the mask, or what was found where there is none; px of the scan. */
  readonly strokes: readonly Stroke[];
  /** It is the technique's own. */
  readonly sample: boolean;
}

export interface PictureFile {
  readonly name: string;
  readonly blob: Blob;
}

export interface Drawn {
  readonly guides: readonly Guide[];
  readonly regions: readonly Stroke[];
  /** Which edges of the picture a morphed grid follows; all where it is not painted. */
  readonly edgeMask: readonly Stroke[];
  /** A file that says what the pieces are. */
  readonly shapes: PictureFile | null;
  /** A file that tells where points are many. */
  readonly density: PictureFile | null;
  /** More pictures that are made of the same wood. */
  readonly targets: readonly PictureFile[];
  /** Of a technique that is made of wood, whatever the picture; null before anybody has chosen any. */
  readonly panels: readonly PanelFile[] | null;
}

export const kNothingDrawn: Drawn = {
  guides: [],
  regions: [],
  edgeMask: [],
  shapes: null,
  density: null,
  targets: [],
  panels: null,
};
export const isNothing = ({ guides, regions, edgeMask, shapes, density }: Drawn) =>
  guides.length + regions.length + edgeMask.length === 0 && !shapes && !density;

/** Colours of the mask of edges, as core/parquetry/edge_picture.h reads them. */
export const kEdgeInks = [
  { title: 'No edges', hint: 'The grid follows no edges there', colour: '#000000' },
  { title: 'Large', hint: 'Only large edges count there', colour: '#ff0000' },
  { title: 'Fine', hint: 'Only fine edges count there', colour: '#0000ff' },
  { title: 'All', hint: 'All edges count there, as everywhere else', colour: '#ffffff' },
] as const;

/** Colours of the parameter regionSizes as it is by default. */
export const kRegions = [
  { title: 'Background', colour: '#0000ff' },
  { title: 'Figure', colour: '#00ff00' },
  { title: 'Detail', colour: '#ff00ff' },
] as const;
const kUnpainted = kRegions[1].colour;
export const kDensity = 'density'; // role and slot
const kGuideWidth = 3; // px

/** Role and slot of one more target: "target-2". */
export const targetRole = (index: number): string => `target-${index + 2}`;

/** A picture that was drawn. Its role in the job names its slot and, with .png, its file, where it has no name yet. */
export interface DrawnPicture {
  role: string;
  name: string;
  blob: Blob;
}

interface Sheet {
  of: 'guides' | 'regions' | 'edgeMask';
  role: string;
  ground: string;
  draw(context: Context2D, drawn: Drawn): void;
}

const kSheets: readonly Sheet[] = [
  { of: 'guides', role: 'edges', ground: '#ffffff', draw: (context, { guides }) => drawGuides(context, guides) },
  {
    of: 'regions',
    role: 'regions',
    ground: kUnpainted,
    draw: (context, { regions }) => regions.forEach((stroke) => drawStroke(context, stroke)),
  },
  {
    of: 'edgeMask',
    role: kEdgeMask,
    ground: '#ffffff',
    draw: (context, { edgeMask }) => edgeMask.forEach((stroke) => drawStroke(context, stroke)),
  },
];

function drawGuides(context: Context2D, guides: readonly Guide[]): void {
  context.strokeStyle = '#000';
  context.lineWidth = kGuideWidth;
  context.lineCap = context.lineJoin = 'round';
  for (const guide of guides) context.stroke(new Path2D(smoothPath(guide)));
}

const made = new Map<string, { from: unknown; size: string; picture: DrawnPicture }>();

/** Of the picture's size, none for what is empty. The same again for the same, so that it is sent once only. */
export async function drawnPictures(drawn: Drawn, { width, height }: Size): Promise<DrawnPicture[]> {
  const pictures: DrawnPicture[] = [];
  if (drawn.density) pictures.push({ role: kDensity, ...drawn.density });
  if (drawn.shapes) pictures.push({ role: kLabels, ...drawn.shapes });
  drawn.targets.forEach((target, i) => pictures.push({ role: targetRole(i), ...target }));
  for (const { of, role, ground, draw } of kSheets) {
    if (drawn[of].length === 0) continue;
    const size = `${width} ${height}`;
    let entry = made.get(role);
    if (entry?.from !== drawn[of] || entry.size !== size) {
      const canvas = new OffscreenCanvas(width, height);
      const context = canvas.getContext('2d', { alpha: false });
      if (!context) throw new Error(`There is not enough memory for a drawing of ${width} × ${height} pixels.`);
      context.fillStyle = ground;
      context.fillRect(0, 0, width, height);
      draw(context, drawn);
      entry = { from: drawn[of], size, picture: { role, name: `${role}.png`, blob: await canvas.convertToBlob() } };
      made.set(role, entry);
    }
    pictures.push(entry.picture);
  }
  return pictures;
}
