// Small boards and a target for the Parquetry tab, and the tab with them in it.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { crc32, deflateSync } from 'node:zlib';
import { unzipSync } from 'fflate';
import { inFolder, native } from '../native.mjs';
import { withApp } from './app.mjs';

/** A PNG of grey or, with opacities, grey with alpha; `dpi` 0 does not tell its resolution. */
export function png(width, height, dpi, greyAt, alphaAt = null) {
  const chunk = (kind, data) => {
    const body = Buffer.concat([Buffer.from(kind, 'latin1'), data]);
    const [length, sum] = [Buffer.alloc(4), Buffer.alloc(4)];
    length.writeUInt32BE(data.length);
    sum.writeUInt32BE(crc32(body));
    return Buffer.concat([length, body, sum]);
  };
  const channels = alphaAt ? 4 : 3;
  const lines = Buffer.alloc(height * (1 + channels * width));
  for (let y = 0, at = 0; y < height; ++y) {
    ++at; // no filter
    for (let x = 0; x < width; ++x) {
      const grey = Math.max(0, Math.min(255, Math.round(greyAt(x, y))));
      for (let c = 0; c < 3; ++c) lines[at++] = grey;
      if (alphaAt) lines[at++] = alphaAt(x, y);
    }
  }
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, alphaAt ? 6 : 2, 0, 0, 0], 8);
  const scale = Buffer.alloc(9);
  scale.writeUInt32BE(Math.round(dpi / 0.0254), 0);
  scale.writeUInt32BE(Math.round(dpi / 0.0254), 4);
  scale[8] = 1;
  return Buffer.concat([
    Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]),
    chunk('IHDR', header),
    ...(dpi ? [chunk('pHYs', scale)] : []),
    chunk('IDAT', deflateSync(lines)),
    chunk('IEND', Buffer.alloc(0)),
  ]);
}

/** Dark where it is near the middle. */
export const target = png(120, 100, 0, (x, y) => 3.4 * Math.hypot(x - 60, y - 50));
/** Boards of 160 x 120 mm or so: light to dark, with grain along x. */
export const grain = (x, y, phase) => 120 + 90 * Math.sin(x / 70 + phase) + 30 * Math.sin(y / 3 + Math.sin(x / 40)) + ((x * 7 + y * 13) % 11);
export const oak = png(320, 240, 50, (x, y) => grain(x, y, 0));
export const elm = png(320, 240, 50, (x, y) => grain(x, y, 2) - 40);

/** The tab on small pictures of one's own; `use` gets them in a folder. */
export const withParquet = (options, use) =>
  inFolder(async (folder) => {
    const files = { 'target.png': target, 'oak.png': oak, 'elm.png': elm };
    for (const [name, bytes] of Object.entries(files)) writeFileSync(join(folder, name), bytes);
    const hash = '#technique=parquetry&imageSizeMm=60&patchMm=10&rotations=4';
    await withApp({ isolated: true, hash, ...options }, async (app, page) => {
      await app.finished();
      await use(app, page, folder);
    });
  });

export const chooseTarget = (page, path) => page.getByLabel('Target', { exact: true }).setInputFiles(path);
export const choosePanels = (page, ...paths) => page.getByLabel('Panels', { exact: true }).setInputFiles(paths);

export async function chooseAll(app, page, folder) {
  await app.change(() => chooseTarget(page, join(folder, 'target.png')));
  await app.change(() => choosePanels(page, join(folder, 'oak.png'), join(folder, 'elm.png')));
}

export const unzip = ({ bytes }) => new Map(Object.entries(unzipSync(bytes)).map(([name, data]) => [name, Buffer.from(data)]));
export const rowsOf = (csv) => csv.toString().trim().split('\n').slice(1).map((line) => line.split(','));

/** That the folder in a ZIP is what the native program makes of the job; its files. `own`: those which only the page has. */
export function sameAsNative(zip, job, folder, own = []) {
  const files = unzip(zip);
  writeFileSync(join(folder, 'job.json'), job.text);
  native('run', join(folder, 'job.json'), '-o', join(folder, 'out/'));
  const made = readdirSync(join(folder, 'out')).sort();
  assert.deepEqual([...files.keys()].filter((name) => !own.includes(name)).sort(), made);
  assert.ok(made.includes('panel-elm.cut.dxf'), made.join());
  for (const name of made.filter((name) => /\.(csv|png|dxf)$/.test(name)))
    assert.ok(files.get(name).equals(readFileSync(join(folder, 'out', name))), `${name} differs`);
  for (const name of made.filter((name) => name.endsWith('.svg'))) {
    const drawn = (svg) => svg.toString().replace(/<metadata>[\s\S]*?<\/metadata>/, '');
    assert.equal(drawn(files.get(name)), drawn(readFileSync(join(folder, 'out', name))), name);
  }
  return files;
}

/** The job that the page would save. */
export const jobOf = async (app) => JSON.parse((await app.download('job')).text);
