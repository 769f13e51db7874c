// The Pebbles tab as people use it.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { validateBytes } from 'gltf-validator';
import { closeBrowser, withApp } from './browser/app.mjs';
import { checkLook, looks } from './browser/looks.mjs';
import { inFolder, native, nativeFile } from './native.mjs';
import { root } from './root.mjs';

after(closeBrowser);

const photo = readFileSync(join(root, 'public/samples/pebbles.png'));
const size = [900, 600]; // of the photo
const fresh = '#technique=pebbles&ground=true&groundHole=true';

/** The pebbles' tab with its sample done and shown in three dimensions. */
const withPebbles = (options, use) =>
  withApp({ isolated: true, hash: fresh, reducedMotion: 'reduce', ...options }, async (app, page) => {
    await app.finished();
    await app.fieldShown();
    await use(app, page);
  });

const jobOf = async (app) => JSON.parse((await app.download('job')).text);
const editsOf = (app) => app.page.locator('#field-edits').inputValue();
/** The number of pebbles that the page tells. */
const countOf = async (app) => Number.parseInt(await app.page.locator('.bar-text strong').textContent(), 10);

const again = async (app) => {
  await app.running();
  await app.finished();
  await app.fieldShown();
};

/** Until the run that is done has found so many; a short run may be over before anybody sees it go on. */
async function untilCount(app, count) {
  await app.page.locator('.bar-text strong').getByText(`${count} pebbles`, { exact: true }).waitFor();
  await app.finished();
}

/** What a GLB says of itself. */
function gltfOf(glb) {
  assert.equal(glb.toString('latin1', 0, 4), 'glTF');
  assert.deepEqual([glb.readUInt32LE(4), glb.readUInt32LE(8)], [2, glb.length]);
  return JSON.parse(glb.toString('utf8', 20, 20 + glb.readUInt32LE(12)));
}

const pebblesOf = ({ nodes }) => nodes.filter(({ name }) => name.startsWith('pebble-')).length;
const verticesOf = ({ meshes, accessors }) =>
  meshes.map(({ primitives }) => accessors[primitives[0].attributes.POSITION].count);

/** The pebbles of the run, the widest first: middle in parts of the photo, across in px. */
async function widest(app) {
  await app.button('More downloads').click();
  const { features } = JSON.parse((await app.download('GeoJSON')).text);
  await app.page.keyboard.press('Escape');
  return features
    .map(({ properties: { centroid, a_px: across } }) => ({ x: centroid[0], y: centroid[1], across }))
    .filter(({ x, y, across }) => Math.min(x, y, size[0] - x, size[1] - y) > across / 2)
    .sort((a, b) => b.across - a.across);
}

const partsOf = ({ x, y }) => [x / size[0], y / size[1]];

async function press(app, ...pebbles) {
  for (const place of await app.onPicture(...size, pebbles.map(partsOf))) await app.page.mouse.click(...place);
}

/** Moves the mouse over the field, from a place given in parts of it, until its label says so. */
async function findInField(page, words, from = [0.5, 0.55]) {
  const box = await page.locator('.field-canvas').boundingBox();
  const label = page.locator('.field-label');
  for (let step = 0; step < 80; ++step) {
    const [u, v] = [from[0] + 0.02 * (step % 8), from[1] - 0.02 * Math.floor(step / 8)];
    await page.mouse.move(box.x + u * box.width, box.y + v * box.height);
    if (words.test(await label.textContent())) return label.textContent();
  }
  throw new Error(`nothing in the field says ${words}`);
}

const lifted = (page, count) => page.locator(`.field-stage[data-lifted="${count}"]`).waitFor();

for (const isolated of [true, false]) {
  const build = isolated ? 'threads' : 'single';

  test(`${build}: a photo in, files out, the same as the native program's`, async () => {
    await withPebbles({ isolated }, async (app, page) => {
      const glb = await app.download('GLB');
      assert.equal(glb.name, 'pebbles.glb');
      const gltf = gltfOf(glb.bytes);
      const { issues } = await validateBytes(new Uint8Array(glb.bytes));
      assert.deepEqual([issues.numErrors, issues.numWarnings], [0, 0], JSON.stringify(issues.messages));
      const job = await app.download('job');
      await inFolder((folder) => {
        const native = gltfOf(nativeFile(folder, job.text, { photo }, 'glb'));
        assert.ok(pebblesOf(gltf) > 100);
        assert.equal(pebblesOf(gltf), pebblesOf(native));
        assert.deepEqual(verticesOf(gltf), verticesOf(native));
      });
      assert.equal((await app.download('CSV')).text.trim().split('\n').length, 1 + pebblesOf(gltf));
      assert.equal(await countOf(app), pebblesOf(gltf));
      assert.equal([...(await app.download('SVG')).text.matchAll(/<path /g)].length, pebblesOf(gltf));
      const outlines = await app.download('PNG');
      assert.equal(outlines.name, 'pebbles.outlines.png');
      assert.deepEqual([outlines.bytes.readUInt32BE(16), outlines.bytes.readUInt32BE(20)], size);
      await page.getByRole('img', { name: /^Grain sizes: D16 [\d.]+ mm, D50 / }).waitFor();
    });
  });
}

test('pebbles are merged, deleted, split and added, and all of it undone', async () => {
  await withPebbles({}, async (app, page) => {
    const before = await countOf(app);
    const [first, second] = await widest(app);
    await press(app, first, second);
    await page.getByText('2 pebbles chosen').waitFor();
    await app.button('Merge').click();
    await again(app);
    assert.match(await editsOf(app), /^merge [\d.]+,[\d.]+ [\d.]+,[\d.]+$/);
    assert.ok((await countOf(app)) < before);

    await page.keyboard.press('Control+z');
    await again(app);
    assert.equal(await editsOf(app), '');
    assert.equal(await countOf(app), before);

    await press(app, first);
    await page.getByText('1 pebble chosen').waitFor();
    await page.keyboard.press('Delete');
    await again(app);
    assert.equal(await countOf(app), before - 1);

    await app.button('Add').click();
    const around = [0, 60, 120, 180, 240, 300, 350].map((degrees) => {
      const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
      return partsOf({ x: first.x + 0.35 * first.across * c, y: first.y + 0.35 * first.across * s });
    });
    await app.drag(await app.onPicture(...size, around));
    await again(app);
    assert.equal(await countOf(app), before);

    await app.button('Split').click();
    const ends = [-0.25, 0.25].map((part) => ({ x: second.x + part * second.across, y: second.y }));
    await press(app, ...ends);
    await again(app);
    assert.match(await editsOf(app), /^delete .*; add .*; split [\d.]+,[\d.]+ [\d.]+,[\d.]+$/);
    assert.equal(await countOf(app), before + 1);
    await app.button('Done').click();
    await page.keyboard.press('Control+z');
    await again(app);
    assert.equal(await countOf(app), before);
    assert.match(await editsOf(app), /^delete [^;]*; add [^;]*$/);
  });
});

test('a label picture made elsewhere says where the pebbles are', async () => {
  await inFolder(async (folder) => {
    const sample = join(root, 'public/samples/pebbles.png');
    const file = join(folder, 'made elsewhere.png');
    native('pebbles', sample, '--smallest', '16', '--labels', file, '-o', join(folder, 'found.csv'));
    native('pebbles', sample, '--segmenter', file, '-o', join(folder, 'again.csv'));
    const pebbles = readFileSync(join(folder, 'again.csv'), 'utf8').trim().split('\n').length - 1;
    const small = join(folder, 'small.png');
    writeFileSync(small, readFileSync(join(root, 'public/icon-192.png')));

    await withPebbles({}, async (app, page) => {
      const searched = await countOf(app);
      assert.ok(pebbles > 60 && pebbles < searched, `${pebbles} of ${searched}`);
      await page.getByLabel('Segmentation', { exact: true }).setInputFiles(file);
      await untilCount(app, pebbles);
      assert.equal(await page.getByLabel('Segmenter', { exact: true }).inputValue(), 'labels');
      const job = await app.download('job');
      const glb = await app.download('GLB');
      const { inputs, params } = JSON.parse(job.text);
      assert.deepEqual([inputs.segmentation, params.segmenter], ['made elsewhere.png', 'labels']);
      const segmentation = readFileSync(file);
      assert.deepEqual(
        verticesOf(gltfOf(nativeFile(folder, job.text, { photo, segmentation }, 'glb'))),
        verticesOf(gltfOf(glb.bytes)),
      );

      await app.button('Remove segmentation').click();
      await untilCount(app, searched);
      assert.equal((await jobOf(app)).inputs.segmentation, undefined);
      await page.keyboard.press('Control+z');
      await untilCount(app, pebbles);
      await page.getByText('pebbles by made elsewhere.png').waitFor();

      await page.getByLabel('Segmentation', { exact: true }).setInputFiles(small);
      await page.getByRole('alert').waitFor();
      assert.match(await page.getByRole('alert').textContent(), /“small\.png” is 192 x 192 px, expected the photo's 900 x 600/);
    });
  });
});

test('a pebble is taken out of the ground and put back', async () => {
  await withPebbles({}, async (app, page) => {
    const id = /^pebble (\d+): press/.exec(await findInField(page, /press to take it out/))[1];
    await page.mouse.down();
    await page.mouse.up();
    await lifted(page, 1);
    await findInField(page, new RegExp(`^pebble ${id} is out`));
    await app.button('Put back').click();
    await lifted(page, 0);
  });
});

async function middleOf(locator, u, v) {
  const box = await locator.boundingBox();
  return [box.x + u * box.width, box.y + v * box.height];
}

test('the scale is set by a line of a known length', async () => {
  await withPebbles({}, async (app, page) => {
    const before = await page.getByRole('img', { name: /^Grain sizes/ }).getAttribute('aria-label');
    await app.button('Set the scale').click();
    await app.drag(await app.onPicture(...size, [[0.1, 0.5], [0.6, 0.5]]));
    await page.getByRole('spinbutton', { name: 'Length' }).fill('12.5');
    await page.getByLabel('Unit').selectOption('mm');
    await page.keyboard.press('Enter');
    await again(app);
    const { params } = await jobOf(app);
    assert.ok(Math.abs(params.pixelsPerM - 36_000) < 400, params.pixelsPerM);
    assert.equal(params.widthM, 0);
    const after = await page.getByRole('img', { name: /^Grain sizes/ }).getAttribute('aria-label');
    const median = (words) => Number(/D50 ([\d.]+) mm/.exec(words)[1]);
    assert.ok(Math.abs(median(before) / median(after) - 40) < 1, `${before}, then ${after}`);
  });
});

test('corrections, scale and the field by keyboard alone', async () => {
  await withPebbles({}, async (app, page) => {
    const before = await countOf(app);
    await app.button('Choose').press('Enter');
    await page.waitForFunction(() => document.activeElement.getAttribute('role') === 'application');
    await page.keyboard.press('Space');
    await page.getByText('1 pebble chosen').first().waitFor();
    await page.keyboard.press('Delete');
    await again(app);
    assert.equal(await countOf(app), before - 1);
    await page.locator('.stage-canvas').focus();
    await page.keyboard.press('r');
    for (const key of ['Space', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Space']) await page.keyboard.press(key);
    await page.keyboard.type('3');
    await page.keyboard.press('Enter');
    await again(app);
    assert.ok((await jobOf(app)).params.pixelsPerM > 0);
    await page.locator('.field-canvas canvas').focus();
    for (const key of ['n', 'n', 'ArrowLeft', '+', '0', 'Enter']) await page.keyboard.press(key);
    await lifted(page, 1);
    await page.getByText('pebble 2 is out').waitFor();
    await page.keyboard.press('Enter');
    await lifted(page, 0);
  });
});

test('another photo forgets the corrections; without WebGL the rest works', async () => {
  await withPebbles({}, async (app, page) => {
    await press(app, (await widest(app))[0]);
    await page.keyboard.press('Delete');
    await again(app);
    assert.match(await editsOf(app), /^delete/);
    await app.open(join(root, 'public/samples/fruit.png'));
    await again(app);
    assert.equal(await editsOf(app), '');

    await page.addInitScript(() => (HTMLCanvasElement.prototype.getContext = () => null));
    await page.reload();
    await app.finished();
    await page.getByText('This browser does not show 3D').waitFor();
    assert.ok((await app.download('GLB')).bytes.length > 1000);
  });
});

/** Counts what the page holds of a graphics card; has to be there before the page is. */
function countGraphics() {
  const held = (window.held = {});
  const { prototype } = WebGL2RenderingContext;
  for (const kind of ['Buffer', 'Texture', 'VertexArray', 'Program']) {
    held[kind] = 0;
    for (const [name, change] of [[`create${kind}`, 1], [`delete${kind}`, -1]]) {
      const whole = prototype[name];
      prototype[name] = function (...words) {
        held[kind] += change;
        return whole.apply(this, words);
      };
    }
  }
}

for (const { name, ...look } of looks) {
  test(`${name}: axe finds no serious violation on the pebbles' tab`, async () => {
    await withPebbles(look, async (app, page) => {
      await checkLook(page, `pebbles-${name}`);
      if (!look.isMobile) return;
      for (const half of ['3D', 'Sizes']) {
        await app.button(half).click();
        await checkLook(page, `pebbles-${half.toLowerCase()}-${name}`);
      }
    });
  });
}
