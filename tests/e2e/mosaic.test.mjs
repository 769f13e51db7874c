// The Mosaic tab as people use it.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { closeBrowser, withApp } from './browser/app.mjs';
import { checkLook, looks } from './browser/looks.mjs';
import { inFolder, nativeFile, nativeSvg } from './native.mjs';
import { root } from './root.mjs';
import { assertSameStones } from './same_stones.mjs';

after(closeBrowser);

const sample = join(root, 'public/samples/coast.png');
const realPhoto = join(root, '../shared/data/mosaic/coffee.png');
const size = [900, 600]; // of the samples

/** The mosaic's tab with its first sample done; what was drawn on arrival is of no interest. */
const withMosaic = (options, use) =>
  withApp({ isolated: true, hash: '#technique=mosaic', ...options }, async (app, page) => {
    await app.finished();
    await use(app, page);
  });

const jobOf = async (app) => JSON.parse((await app.download('job')).text);
const svgOf = async (app) => (await app.download('SVG')).text.replace(/<metadata>[\s\S]*?<\/metadata>/, '');

/** How many frames an animated PNG promises, and has. */
function framesOf(png) {
  const kinds = [];
  let promised = 0;
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    kinds.push(png.toString('latin1', at + 4, at + 8));
    if (kinds.at(-1) === 'acTL') promised = png.readUInt32BE(at + 8);
  }
  return [promised, kinds.filter((kind) => kind === 'fcTL').length];
}

/** The numbers of tiles in a bill of materials. */
function countsOf(csv) {
  const [head, ...lines] = csv.trim().split(/\r?\n/);
  const column = head.split(',').indexOf('count');
  return lines.map((line) => Number(line.split(',')[column]));
}

for (const isolated of [true, false]) {
  const build = isolated ? 'threads' : 'single';

  test(`${build}: a photo in, files out, the same as the native program's`, async (t) => {
    if (!existsSync(realPhoto)) t.diagnostic('without a real photo: ../shared is not here');
    const photo = existsSync(realPhoto) ? realPhoto : sample;
    await withMosaic({ isolated }, async (app, page) => {
      await app.open(photo);
      await app.running();
      await app.finished();
      await page.getByRole('combobox', { name: 'Palette' }).selectOption('number');
      await app.running();
      await app.finished();
      const svg = await app.download('SVG');
      const job = await app.download('job');
      assert.equal(JSON.parse(job.text).technique, 'mosaic');
      assert.match((await app.download('DXF')).text, /^\s*0\r?\nSECTION[\s\S]*EOF\s*$/);
      assert.ok((await app.download('PNG')).bytes.length > 1000);
      const counts = countsOf((await app.download('bill of materials')).text);
      const tiles = [...svg.text.matchAll(/<path /g)].length;
      assert.equal(counts.length, 16);
      assert.equal(counts.reduce((sum, count) => sum + count), tiles);
      await inFolder((folder) =>
        assertSameStones(svg.text, nativeSvg(folder, job.text, { photo: readFileSync(photo) })),
      );
      await app.button('More downloads').click();
      assert.equal(JSON.parse((await app.download('GeoJSON')).text).features.length, tiles);
      assert.equal((await app.download('CSV')).text.trim().split('\n').length, tiles + 1);
    });
  });

  test(`${build}: the animation and the solid tiles are made when asked for, and are the native program's`, async (t) => {
    await withMosaic({ isolated }, async (app, page) => {
      const job = await app.download('job');
      const pictures = { photo: readFileSync(join(root, 'public/samples/fruit.png')) };
      await app.button('More downloads').click();
      const begin = performance.now();
      const animation = await app.demand('animation');
      t.diagnostic(`${Math.round(performance.now() - begin)} ms, ${animation.bytes.length} bytes`);
      assert.equal(animation.name, 'fruit-mosaic.animation.png');
      assert.deepEqual(framesOf(animation.bytes), [22, 22]); // the mosaic, and 20 iterations from the first sites on
      await inFolder((folder) =>
        assert.ok(animation.bytes.equals(nativeFile(folder, job.text, pictures, 'apng')), 'not the native bytes'),
      );
      assert.equal((await app.demand('GLB')).text.slice(0, 4), 'glTF');

      // Another run, another animation; what a stopped one took with it is told.
      await app.set('Iterations', 3);
      await app.running();
      await app.finished();
      assert.deepEqual(framesOf((await app.demand('animation')).bytes), [5, 5]);
      await app.set('Iterations', 900);
      await app.running();
      await page.waitForFunction(() => document.querySelector('[role=progressbar]')?.ariaValueNow > 5); // in the engine
      await app.button('Cancel').click(); // which folds "More" away
      await app.button('More downloads').click();
      await app.button('Download GLB').click();
      await page.locator('.bar-text').getByText(/Generate once more/).waitFor();
    });
  });
}

test('guide curves and sizes change the mosaic, are undone, and go to the command line', async () => {
  await withMosaic({}, async (app, page) => {
    const before = await svgOf(app);
    await app.button('Curves').click();
    await app.drag(await app.onPicture(...size, [[0.1, 0.15], [0.3, 0.35], [0.6, 0.2], [0.9, 0.3]]));
    await app.running();
    await app.finished();
    await page.getByText('1 curve', { exact: true }).waitFor();
    const guided = await svgOf(app);
    assert.notEqual(guided, before);
    await app.button('Done').click();

    await app.button('Sizes').click();
    await app.drag(await app.onPicture(...size, [[0.45, 0.6], [0.75, 0.6]]));
    await app.running();
    await app.finished();
    await app.button('Done').click();
    const both = await app.download('SVG');
    const job = await app.download('job');
    assert.deepEqual(JSON.parse(job.text).inputs, { photo: 'fruit.png', edges: 'edges.png', regions: 'regions.png' });
    await app.button('More downloads').click();
    const pictures = { photo: readFileSync(join(root, 'public/samples/fruit.png')) };
    for (const role of ['edges', 'regions']) pictures[role] = (await app.download(`${role}.png`)).bytes;
    await inFolder((folder) => assertSameStones(both.text, nativeSvg(folder, job.text, pictures)));

    for (const then of [guided, before]) {
      await page.keyboard.press('Control+z');
      await app.running();
      await app.finished();
      assert.equal(await svgOf(app), then);
    }
    assert.deepEqual((await jobOf(app)).inputs, { photo: 'fruit.png' });
  });
});

test('a point of a curve can be dragged, all curves cleared', async () => {
  await withMosaic({}, async (app, page) => {
    await app.button('Curves').click();
    const [from, to, aside] = await app.onPicture(...size, [[0.2, 0.2], [0.8, 0.2], [0.8, 0.7]]);
    await app.drag([from, to]);
    await app.running();
    await app.finished();
    const straight = await svgOf(app);
    await app.drag([to, aside]);
    await app.running();
    await app.finished();
    assert.notEqual(await svgOf(app), straight);
    await page.getByText('1 curve', { exact: true }).waitFor(); // moved, not drawn
    await app.button('Clear all curves').click();
    await app.running();
    await app.finished();
    assert.equal((await jobOf(app)).inputs.edges, undefined);
  });
});

test('curves and sizes by keyboard alone', async () => {
  await withMosaic({}, async (app, page) => {
    const begin = async (tool) => {
      await app.button(tool).press('Enter');
      await page.waitForFunction(() => document.activeElement.getAttribute('role') === 'application');
    };
    await begin('Curves');
    for (const key of [' ', 'Shift+ArrowRight', 'Shift+ArrowRight', ' ', 'Shift+ArrowDown', ' ', 'Enter'])
      await page.keyboard.press(key === ' ' ? 'Space' : key);
    await app.running();
    await page.getByText('1 curve', { exact: true }).waitFor();
    await app.finished();
    await begin('Sizes');
    for (const key of ['Space', 'Shift+ArrowRight', 'Shift+ArrowRight', 'Space']) await page.keyboard.press(key);
    await app.running();
    await app.finished();
    assert.deepEqual(Object.keys((await jobOf(app)).inputs).sort(), ['edges', 'photo', 'regions']);
  });
});

test('a palette of real tiles is pasted, counted and named in the bill', async () => {
  await withMosaic({}, async (app, page) => {
    await page.getByRole('combobox', { name: 'Palette' }).selectOption('list');
    await app.finished();
    await app.button('Paste a list').click();
    await page.getByLabel('List of tile colours').fill('Chalk #f4f1e8\nBrick, 140, 74, 50\nSea;#3f6f8a');
    await app.button('Use these 3 colours').click();
    await app.running();
    await app.finished();
    assert.equal((await jobOf(app)).params.palette, 'Chalk #f4f1e8, Brick #8c4a32, Sea #3f6f8a');
    const bill = (await app.download('bill of materials')).text;
    for (const name of ['Chalk', 'Brick', 'Sea']) assert.match(bill, new RegExp(name));
    const counts = await page.locator('.tile-count').allTextContents();
    const tiles = [...(await svgOf(app)).matchAll(/<path /g)].length;
    assert.equal(counts.reduce((sum, count) => sum + Number(count.replace(',', '')), 0), tiles);
  });
});

test('each tab keeps what is its own, and jobs open in theirs', async () => {
  await inFolder(async (folder) => {
    await withApp({ isolated: true }, async (app, page) => {
      await app.finished();
      await app.set('Half side', 7);
      await app.running();
      await app.finished();
      const pavement = await app.download('job');
      await app.openTab('Mosaic');
      assert.equal(await app.button('Type').count(), 0);
      assert.match(page.url(), /technique=mosaic/);
      const job = await jobOf(app);
      assert.equal(job.inputs.photo, 'fruit.png');
      assert.equal(job.params.halfSide, undefined);
      await page.reload();
      await app.finished();
      assert.equal((await jobOf(app)).technique, 'mosaic');
      const path = join(folder, 'job.json');
      writeFileSync(path, pavement.text);
      await app.openJob(path);
      await app.running();
      await app.finished();
      assert.equal(await page.getByRole('tab', { name: 'Pavement' }).getAttribute('aria-selected'), 'true');
      assert.deepEqual(await jobOf(app), JSON.parse(pavement.text));
    });
  });
});

test('a picture is dropped on the page, and pasted', async () => {
  await withMosaic({}, async (app, page) => {
    const bytes = readFileSync(sample).toString('base64');
    for (const [type, name] of [['drop', 'dropped.png'], ['paste', 'pasted.png']]) {
      await page.evaluate(
        ([type, name, bytes]) => {
          const files = new DataTransfer();
          const content = Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0));
          files.items.add(new File([content], name, { type: 'image/png' }));
          const options = { bubbles: true, cancelable: true };
          document.body.dispatchEvent(
            type === 'drop'
              ? new DragEvent('drop', { ...options, dataTransfer: files })
              : new ClipboardEvent('paste', { ...options, clipboardData: files }),
          );
        },
        [type, name, bytes],
      );
      await app.running();
      await app.finished();
      assert.equal((await jobOf(app)).inputs.photo, name);
    }
  });
});

for (const { name, ...look } of looks) {
  test(`${name}: axe finds no serious violation on the mosaic's tab`, async () => {
    await withMosaic(look, async (app, page) => {
      await checkLook(page, `mosaic-${name}`);
      if (look.isMobile) return;
      await app.button('Curves').click();
      await app.drag(await app.onPicture(...size, [[0.1, 0.15], [0.3, 0.35], [0.6, 0.2], [0.9, 0.3]]));
      await app.finished();
      await checkLook(page, `mosaic-curves-${name}`);
    });
  });
}
