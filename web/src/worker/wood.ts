// A finished parquetry's folder: as one file, and what the page shows of it.

import { zipSync, type Zippable } from 'fflate';
import type { Artifact, Job, RunResult } from 'tessera-wasm';
import type { Pieces } from './pieces';
import type { PanelPicture, Wood, WoodPiece } from './protocol';

const kFolder = 'folder/';
const kFirstDay = new Date(1980, 0, 1); // ZIP's; the same job makes the same bytes

export interface Made {
  files: readonly Artifact[];
  report: object;
  /** By their files' names. */
  masks: Readonly<Record<string, Uint8Array>>;
}

export const fileOf = (files: readonly Artifact[], name: string): Artifact | undefined =>
  files.find((file) => file.name === kFolder + name);

export const blobOf = ({ bytes, mediaType }: Artifact): Blob =>
  new Blob([bytes as Uint8Array<ArrayBuffer>], { type: mediaType });

/** All of it, with what the page knows of the run as report.json, and masks that were drawn here. */
export function zipped({ files, report, masks }: Made): Blob {
  const inside: Zippable = {};
  for (const [name, bytes] of Object.entries(masks)) inside[name] = [bytes, { level: 0, mtime: kFirstDay }];
  // Pictures are packed already.
  for (const { name, bytes } of files)
    inside[name.slice(kFolder.length)] = [bytes, { level: name.endsWith('.png') ? 0 : 6, mtime: kFirstDay }];
  const text = new TextEncoder().encode(`${JSON.stringify(report, null, 2)}\n`);
  inside['report.json'] = [text, { mtime: kFirstDay }];
  return new Blob([zipSync(inside) as Uint8Array<ArrayBuffer>], { type: 'application/zip' });
}

/** As the command line's reports have it; nothing where a page is not to be trusted with that. */
export async function checksum(bytes: BufferSource): Promise<{ sha256?: string }> {
  if (!globalThis.crypto?.subtle) return {};
  const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', bytes));
  return { sha256: Array.from(digest, (byte) => byte.toString(16).padStart(2, '0')).join('') };
}

export async function reportOf(
  version: string,
  threads: number,
  { technique, seed, params }: Job,
  inputs: readonly { path: string; width: number; height: number; sha256?: string }[],
  { backend, counts, metrics }: RunResult,
  stages: readonly { name: string; ms: number }[],
  files: readonly Artifact[],
): Promise<object> {
  const outputs = files.map(async ({ name, bytes }) => ({
    path: name.slice(kFolder.length),
    bytes: bytes.length,
    ...(await checksum(bytes as Uint8Array<ArrayBuffer>)),
  }));
  return {
    tessera: version,
    technique,
    seed,
    backend,
    threads,
    inputs,
    params,
    stages,
    total_ms: stages.reduce((sum, { ms }) => sum + ms, 0),
    counts,
    metrics,
    outputs: await Promise.all(outputs),
  };
}

/** All finished pieces side by side, as the engine's sheet has them, and how high the first is; null where there is none. */
export async function previewOf(
  files: readonly Artifact[],
): Promise<{ all: ImageBitmap; firstHeight: number } | null> {
  const pictures = await Promise.all(
    files
      .filter(({ name }) => /^folder\/preview(-\d+)?\.png$/.test(name))
      .map((file) => createImageBitmap(blobOf(file))),
  );
  const [first] = pictures;
  if (!first) return null;
  const firstHeight = first.height;
  if (pictures.length < 2) return { all: first, firstHeight };
  const width = pictures.reduce((sum, picture) => sum + picture.width, 0);
  const canvas = new OffscreenCanvas(width, Math.max(...pictures.map(({ height }) => height)));
  let x = 0;
  for (const picture of pictures) {
    canvas.getContext('2d')?.drawImage(picture, x, 0);
    x += picture.width;
    picture.close();
  }
  return { all: canvas.transferToImageBitmap(), firstHeight };
}

/** The names in a cut file, whose paths are in the order they are cut. */
export const cutOrder = (svg: string): string[] => Array.from(svg.matchAll(/ id="cut-([^"]+)"/g), ([, id]) => id!);

/** Rows of pieces.csv, whose cells are plain. */
function rowsOf(csv: string): Record<string, string>[] {
  const [head = '', ...lines] = csv.trim().split('\n');
  const keys = head.split(',');
  return lines.map((line) => {
    const cells = line.split(',');
    return Object.fromEntries(keys.map((key, i) => [key, cells[i] ?? '']));
  });
}

/** `pieces`: the same as in the table, in its order, in pixels `mmPerPx` wide. */
export function woodPieces(csv: string, pieces: Pieces, mmPerPx: number): WoodPiece[] {
  return rowsOf(csv).map((row, i) => {
    const turn = Number(row['rotation_deg']);
    const middle = { x: Number(row['x_mm']), y: Number(row['y_mm']) };
    return {
      id: row['id'] ?? '',
      row: Number(row['row']),
      column: Number(row['column']),
      panel: row['panel'] ?? '',
      onPanel: turnedBack(outerRing(pieces, i, mmPerPx), turn, middle),
      turn,
      cost: Number(row['cost']),
    };
  });
}

function outerRing({ pieceStarts, ringStarts, points }: Pieces, piece: number, mmPerPx: number): number[] {
  const ring = pieceStarts[piece]!;
  return Array.from(points.subarray(2 * ringStarts[ring]!, 2 * ringStarts[ring + 1]!), (px) => px * mmPerPx);
}

/** A ring of the finished piece where it is cut: its centroid comes to lie at `middle`. */
export function turnedBack(ring: readonly number[], turn: number, middle: { x: number; y: number }): number[] {
  const centre = centroid(ring);
  const angle = (turn * Math.PI) / 180;
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const turned: number[] = [];
  for (let k = 0; k < ring.length; k += 2) {
    const [dx, dy] = [ring[k]! - centre.x, ring[k + 1]! - centre.y];
    turned.push(middle.x + c * dx + s * dy, middle.y - s * dx + c * dy);
  }
  return turned;
}

function centroid(ring: readonly number[]): { x: number; y: number } {
  let [area, x, y] = [0, 0, 0];
  const [ox, oy] = [ring[0]!, ring[1]!]; // near, so that nothing cancels
  for (let k = 0, j = ring.length - 2; k < ring.length; j = k, k += 2) {
    const [ax, ay, bx, by] = [ring[j]! - ox, ring[j + 1]! - oy, ring[k]! - ox, ring[k + 1]! - oy];
    const cross = ax * by - bx * ay;
    area += cross;
    x += (ax + bx) * cross;
    y += (ay + by) * cross;
  }
  return { x: ox + x / (3 * area), y: oy + y / (3 * area) };
}

/** `panels`: the names of the job's, in the order they are shown. */
export async function woodOf(
  files: readonly Artifact[],
  pieces: Pieces,
  mmPerPx: number,
  panels: readonly string[],
  scale: number,
): Promise<Wood> {
  const csv = new TextDecoder().decode(fileOf(files, 'pieces.csv')?.bytes);
  const assembly = fileOf(files, 'assembly.svg');
  const pictures = await Promise.all(
    panels.map(async (name): Promise<PanelPicture | null> => {
      const preview = fileOf(files, `panel-${name}.preview.png`);
      if (!preview) return null;
      const picture = blobOf(preview);
      const bitmap = await createImageBitmap(picture);
      const { width, height } = bitmap;
      bitmap.close();
      const order = cutOrder(new TextDecoder().decode(fileOf(files, `panel-${name}.cut.svg`)?.bytes));
      return { name, widthMm: width * mmPerPx, heightMm: height * mmPerPx, picture, order };
    }),
  );
  return {
    pieces: woodPieces(csv, pieces, mmPerPx),
    panels: pictures.filter((picture) => picture !== null),
    assembly: assembly ? blobOf(assembly) : new Blob(),
    scale,
  };
}
