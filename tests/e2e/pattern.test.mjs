// The Pattern tab as people use it: no picture is needed.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { closeBrowser, withApp } from './browser/app.mjs';
import { checkLook, looks } from './browser/looks.mjs';
import { inFolder, nativeFile, nativeOutput, nativeSvg } from './native.mjs';
import { root } from './root.mjs';
import { assertSameStones } from './same_stones.mjs';

after(closeBrowser);

/** The tab with what it begins with done. */
const withPattern = (options, use) =>
  withApp({ isolated: true, hash: '#technique=pattern', ...options }, async (app, page) => {
    await app.finished();
    await use(app, page);
  });

const jobOf = async (app) => JSON.parse((await app.download('job')).text);
const piecesIn = (svg) => [...svg.matchAll(/<path /g)].length;

/** Red, green, blue at places of a PNG, parts of its width and height. */
const coloursAt = (page, png, places) =>
  page.evaluate(
    async ([bytes, places]) => {
      const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))]));
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d', { willReadFrequently: true });
      context.drawImage(bitmap, 0, 0);
      return places.map(([u, v]) => {
        const [x, y] = [Math.floor(u * bitmap.width), Math.floor(v * bitmap.height)];
        return [...context.getImageData(x, y, 1, 1).data].slice(0, 3);
      });
    },
    [png.toString('base64'), places],
  );

const choose = (app, model) => app.change(() => app.button(model).click());

for (const isolated of [true, false]) {
  const build = isolated ? 'threads' : 'single';

  test(`${build}: patterns without a picture, the same as the native program's`, async () => {
    await withPattern({ isolated }, async (app, page) => {
      assert.equal((await app.threads()) > 1, isolated);
      const models = [['Occupancy', 'cell'], ['Johnson-Mehl', 'cell'], ['Ellipses', 'bomb'], ['Points', 'point']];
      for (const [model, kind] of models) {
        if (model !== 'Occupancy') await choose(app, model);
        const svg = await app.download('SVG');
        const job = await app.download('job');
        assert.deepEqual(JSON.parse(job.text).inputs, {});
        assert.equal(svg.name, `${model.toLowerCase()}-pattern.svg`);
        const told = await page.locator('.bar-text strong').textContent();
        assert.equal(told, `${piecesIn(svg.text).toLocaleString('en')} ${kind}s`);
        await inFolder((folder) => assertSameStones(svg.text, nativeSvg(folder, job.text, {})));
      }
    });
  });

  test(`${build}: pieces come while a slider is dragged`, async () => {
    await withPattern({ isolated }, async (app, page) => {
      const slider = page.getByRole('slider', { name: 'Size' });
      const box = await slider.boundingBox();
      const places = [0.35, 0.5, 0.7, 0.9].map((part) => [box.x + part * box.width, box.y + box.height / 2]);
      const counts = new Set();
      await page.mouse.move(box.x + 0.2 * box.width, places[0][1]);
      await page.mouse.down();
      for (const place of places) {
        await app.change(() => page.mouse.move(...place, { steps: 5 }));
        counts.add(await page.locator('.bar-text strong').textContent());
      }
      await page.mouse.up();
      assert.equal(counts.size, places.length);
      const dragged = (await jobOf(app)).params.size;
      assert.ok(dragged > 100, String(dragged));
      await app.change(() => app.button('Undo').click()); // the whole drag
      assert.equal((await jobOf(app)).params.size, 24);
    });
  });
}

test('files of every kind; noise is shown, too', async () => {
  const hash = '#technique=pattern&model=hexagon&variation=within';
  await withPattern({ hash }, async (app, page) => {
    const count = piecesIn((await app.download('SVG')).text);
    assert.match((await app.download('DXF')).text, /^\s*0\r?\nSECTION[\s\S]*EOF\s*$/);
    const samePicture = async () => {
      const job = await app.download('job');
      const png = (await app.download('PNG')).bytes;
      await inFolder((folder) => assert.ok(png.equals(nativeFile(folder, job.text, {}, 'png')), 'another picture'));
    };
    await samePicture();
    await app.button('More downloads').click();
    assert.equal(JSON.parse((await app.download('GeoJSON')).text).features.length, count);
    assert.equal((await app.download('CSV')).text.trim().split('\n').length, count + 1);
    assert.equal((await app.demand('GLB')).text.slice(0, 4), 'glTF');
    await app.change(() => page.evaluate(() => void (location.hash = '#technique=pattern&model=gaussian&width=256&height=256')));
    await page.getByText('65,536 cells', { exact: true }).first().waitFor();
    await samePicture();
  });
});

test('a job is opened again, shared by its address, undone', async () => {
  await inFolder(async (folder) => {
    await withPattern({}, async (app, page) => {
      await choose(app, 'Circles');
      await app.change(() => app.set('Length', 33));
      await app.change(() => app.button('Roll the dice for another seed').click());
      const job = await app.download('job');
      const svg = await app.download('SVG');
      assert.equal(JSON.parse(job.text).params.length, 33);
      await page.waitForURL(/model=circles/);
      await page.reload();
      await app.finished();
      assert.deepEqual(await jobOf(app), JSON.parse(job.text));
      for (const file of [job, svg]) {
        writeFileSync(join(folder, file.name), file.text);
        await choose(app, 'Delaunay');
        await app.change(() => app.openJob(join(folder, file.name)));
        assert.deepEqual(await jobOf(app), JSON.parse(job.text));
        assert.equal((await app.download('SVG')).text, svg.text);
      }
      await app.change(() => app.button('Undo').click());
      assert.equal((await jobOf(app)).params.model, 'delaunay');
      await app.change(() => app.button('Redo').click());
      assert.equal((await jobOf(app)).params.model, 'circles');
      await app.change(() => page.evaluate(() => void (location.hash = '#technique=pattern&model=hexagon&size=9')));
      const { model, size } = (await jobOf(app)).params;
      assert.deepEqual({ model, size }, { model: 'hexagon', size: 9 });
    });
  });
});

test('other tabs keep their picture, and have one where this was opened first', async () => {
  const coast = join(root, 'public/samples/coast.png');
  await withPattern({}, async (app, page) => {
    assert.equal(await page.getByRole('slider', { name: 'Before and after' }).count(), 0);
    await app.openTab('Pavement');
    assert.deepEqual((await jobOf(app)).inputs, { drawing: 'waves.png' });
    await app.openTab('Mosaic');
    await app.change(() => app.open(coast));
    await app.change(() => page.getByRole('tab', { name: 'Pattern' }).click());
    assert.deepEqual((await jobOf(app)).inputs, {});
    await app.change(() => page.getByRole('tab', { name: 'Mosaic' }).click());
    assert.deepEqual((await jobOf(app)).inputs, { photo: 'coast.png' });
    await app.button('Fit').click();
    await page.getByRole('slider', { name: 'Before and after' }).press('End');
    const middle = [[0.5, 0.5]];
    const [seen] = await coloursAt(page, await page.locator('.stage-canvas').screenshot(), middle);
    const [own] = await coloursAt(page, readFileSync(coast), middle);
    assert.ok(own.every((level, c) => Math.abs(level - seen[c]) < 16), `${seen} on the stage, ${own} in the photo`);
  });
});

test('a tab left while its sample comes does not disturb this one', async () => {
  await withApp({ isolated: true, hash: '#technique=pattern' }, async (app, page) => {
    await app.finished();
    let release;
    const held = new Promise((go) => (release = go));
    await page.route('**/samples/waves.png', async (route) => {
      await held;
      await route.continue();
    });
    await page.getByRole('tab', { name: 'Pavement' }).click();
    await app.change(() => page.getByRole('tab', { name: 'Pattern' }).click());
    release();
    await choose(app, 'Triangle');
    assert.equal((await jobOf(app)).params.model, 'triangle');
    await app.openTab('Pavement');
    assert.deepEqual((await jobOf(app)).inputs, { drawing: 'waves.png' });
  });
});

test('a seamless sheet shows at one side what sticks out at the other', async () => {
  const hash = '#technique=pattern&model=circles&size=60&length=80&width=256&height=256&seamless=true';
  await withPattern({ hash, reducedMotion: 'reduce' }, async (app, page) => {
    const png = (await app.download('PNG')).bytes;
    await app.button('True size, 1:1').click();
    await page.mouse.move(5, 5);
    const box = await page.locator('.stage-canvas').boundingBox();
    const [x, y] = [box.x + box.width / 2 - 128, box.y + box.height / 2 - 128];
    const along = Array.from({ length: 60 }, (_, i) => (i + 0.5) / 60);
    const sides = [0.02, 0.98].flatMap((at) => along.flatMap((v) => [[at, v], [v, at]]));
    const made = await coloursAt(page, png, sides);
    assert.ok(new Set(made.map(String)).size > 1);
    let differing;
    for (let i = 0; i < 10 && !(differing < 12); ++i) {
      // until the crisp drawing is there
      const seen = await coloursAt(page, await page.screenshot({ clip: { x, y, width: 256, height: 256 } }), sides);
      differing = seen.filter((colour, k) => colour.some((level, c) => Math.abs(level - made[k][c]) > 80)).length;
    }
    assert.ok(differing < 12, `${differing} of ${sides.length} places along the sides differ`);
  });
});

test('colours are added, changed and removed with their shares', async () => {
  await withPattern({}, async (app, page) => {
    await app.change(() => page.getByLabel('Colour 1', { exact: true }).fill('#00aa00'));
    assert.match((await app.download('SVG')).text, /fill="#00aa00"/);
    await app.change(() => app.button('Add a colour').click());
    assert.equal((await jobOf(app)).params.colors, '#00aa00 #e4dbcb #22313f #7a8f94 #7a8f94');
    await page.locator('.more summary').click();
    await app.change(() => page.getByRole('textbox', { name: 'Probabilities' }).fill('1 1 1 1 4'));
    await app.change(() => app.button('Remove colour 2').click());
    const { colors, probabilities } = (await jobOf(app)).params;
    assert.deepEqual([colors, probabilities], ['#00aa00 #22313f #7a8f94 #7a8f94', '1 1 1 4']);
  });
});

test('only parameters that matter are shown, and what is wrong is told at its field', async () => {
  await withPattern({}, async (app, page) => {
    const shown = (name) => page.getByRole('spinbutton', { name, exact: false });
    assert.equal(await shown('Length').count(), 0);
    await choose(app, 'Rectangles');
    assert.equal(await shown('Length').count(), 1);
    assert.equal(await shown('Border').count(), 0);
    await page.getByRole('textbox', { name: 'Colors' }).fill('red');
    await page.getByText(/is no list of 1 to 256 colours/).first().waitFor();
    await app.change(() => page.getByRole('textbox', { name: 'Colors' }).fill('#f00 #fff'));
    assert.equal(await page.getByRole('alert').count(), 0);
  });
});

test('a picture tells where points are many', async () => {
  const picture = join(root, 'public/samples/waves.png');
  await withPattern({}, async (app) => {
    await app.change(() => app.open(picture));
    const svg = await app.download('SVG');
    const job = await app.download('job');
    const { inputs, params } = JSON.parse(job.text);
    assert.deepEqual([inputs, params.process], [{ density: 'waves.png' }, 'cox']);
    await inFolder((folder) => assertSameStones(svg.text, nativeSvg(folder, job.text, { density: readFileSync(picture) })));
    await app.change(() => app.button('Undo').click());
    assert.deepEqual((await jobOf(app)).inputs, {});
  });
});

/** Opens the statistics, and waits until they are those of the pattern that is shown. */
async function statistics(page) {
  const fold = page.getByRole('button', { name: 'Statistics', exact: true });
  if ((await fold.getAttribute('aria-expanded')) === 'false') await fold.press('Enter');
  await measured(page);
}

const measured = async (page) => {
  await page.locator('.statistics-body[aria-busy=false] .chart').waitFor();
};

/** What the native program reports of a file, but for what it says of that file. */
function nativeReport(command, { name, bytes }) {
  return inFolder((folder) => {
    writeFileSync(join(folder, name), bytes);
    const { inputs, seed, ...report } = JSON.parse(nativeOutput(command, join(folder, name)));
    return report;
  });
}

const savedReport = async (app) => {
  const { job, ...report } = JSON.parse((await app.downloadBy(app.button('Save statistics as JSON'))).text);
  return { job, report };
};

for (const isolated of [true, false]) {
  const build = isolated ? 'threads' : 'single';

  test(`${build}: statistics of what is shown, the same as the native program's`, async () => {
    await withPattern({ isolated }, async (app, page) => {
      await statistics(page);
      const shown = [['Occupancy', 'SVG', 'cells'], ['Hexagon', 'SVG', 'cells'], ['Points', 'SVG', 'points'], ['Circles', 'PNG', 'picture']];
      for (const [model, kind, what] of shown) {
        if (model !== 'Occupancy') await choose(app, model);
        await measured(page);
        const { job, report } = await savedReport(app);
        assert.deepEqual(job, await jobOf(app));
        assert.equal(report.kind, what);
        assert.deepEqual(report, await nativeReport('measure', await app.download(kind)));
      }
    });
  });

  test(`${build}: a picture is fitted, and more of the same made`, async () => {
    await withPattern({ isolated, hash: '#technique=pattern&model=hexagon&size=14&width=300&height=200' }, async (app, page) => {
      const picture = await app.download('PNG');
      await inFolder(async (folder) => {
        const path = join(folder, 'tiles.png');
        writeFileSync(path, picture.bytes);
        await choose(app, 'Occupancy');
        await page.getByLabel('Picture to fit').setInputFiles(path);
        await app.button('Use').waitFor();
        await page.locator('.fit-best').getByText('Hexagon').waitFor();
        const report = await nativeReport('fit', picture);
        const rows = await page.locator('.fit-result tbody tr').allInnerTexts();
        assert.equal(rows.length, report.candidates.length);
        const digits = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });
        for (const [i, { distance, w_residual: residual }] of report.candidates.entries())
          assert.deepEqual(rows[i].trim().split(/\s+/).slice(-2), [digits.format(distance), digits.format(residual)]);
        assert.equal((await jobOf(app)).params.model, 'occupancy', 'nothing changes before it is used');
        await app.change(() => app.button('Use').click());
        const job = await jobOf(app);
        assert.deepEqual(job.params, report.job.params);
        const [seen] = await coloursAt(page, await beforeOf(page), [[0.5, 0.5]]);
        const [own] = await coloursAt(page, picture.bytes, [[0.5, 0.5]]);
        assert.ok(own.every((level, c) => Math.abs(level - seen[c]) < 16), `${seen} before, ${own} in the picture`);
        await app.change(() => app.button('Undo').click());
        assert.equal((await jobOf(app)).params.model, 'occupancy');
        assert.equal(await page.getByRole('slider', { name: 'Before and after' }).count(), 0);
      });
    });
  });
}

/** The stage with the divider at its right end. */
async function beforeOf(page) {
  await page.getByRole('slider', { name: 'Before and after' }).press('End');
  return page.locator('.stage-canvas').screenshot();
}

test('the curve and the numbers are chosen and read without a mouse', async () => {
  await withPattern({}, async (app, page) => {
    await statistics(page);
    const chart = page.locator('.chart svg');
    assert.match(await chart.getAttribute('aria-label'), /^Both ends of a needle in one cell.*beside closed form$/);
    assert.equal(await page.locator('.chart-series[data-series="1"] path').count(), 1);
    await app.button('Sides').press('Enter');
    assert.match(await chart.getAttribute('aria-label'), /^Sides.* 6: 0\.\d/);
    await app.button('Areas').press('Space');
    assert.match(await chart.getAttribute('aria-label'), /^Areas/);
    const { report } = await savedReport(app);
    const row = page.locator('.figures tr', { hasText: 'Sides' });
    const [told] = /[\d.]+(?= ±)/.exec(await row.innerText());
    assert.ok(Math.abs(told - report.sides.mean) < report.sides.error / 5, `${told} for ${report.sides.mean}`);
    await choose(app, 'Delaunay'); // which has no W
    await measured(page);
    await app.button('W(d)').click();
    assert.equal(await page.locator('.chart-series').count(), 1);
    await app.change(() => app.set('Size', 40));
    await measured(page);
    assert.deepEqual((await savedReport(app)).job, await jobOf(app));
    await page.getByRole('button', { name: 'Statistics', exact: true }).press('Enter');
    assert.equal(await chart.count(), 0);
  });
});

/** Files dropped on an element, as a hand does it. */
async function drop(page, selector, name, buffer) {
  const transfer = await page.evaluateHandle(
    ([name, bytes]) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name, { type: 'image/png' }));
      return data;
    },
    [name, buffer.toString('base64')],
  );
  for (const type of ['dragenter', 'dragover', 'drop']) await page.dispatchEvent(selector, type, { dataTransfer: transfer });
}

// Its fit takes many times as long as what the page is asked for meanwhile.
const kLargePattern = 'pattern occupancy --intensity 0.01 --width 2400 --height 2400 --format png -o -'.split(' ');

for (const isolated of [true, false]) {
  test(`${isolated ? 'threads' : 'single'}: a fit can be cancelled, and gives way to a run`, async () => {
    await withPattern({ isolated }, async (app, page) => {
      const large = { name: 'large.png', mimeType: 'image/png', buffer: nativeOutput(...kLargePattern) };
      await page.getByLabel('Picture to fit').setInputFiles(large);
      await app.button('Cancel fit').press('Enter');
      await app.button('Cancel fit').waitFor({ state: 'detached' });
      await page.getByLabel('Picture to fit').setInputFiles(large);
      await app.button('Cancel fit').waitFor();
      await choose(app, 'Triangle');
      await app.button('Cancel fit').waitFor({ state: 'detached' });
      assert.equal(await app.button('Use').count(), 0);
      assert.equal(await page.getByRole('alert').count(), 0);
      assert.equal((await jobOf(app)).params.model, 'triangle');
      await statistics(page);
      assert.equal((await savedReport(app)).report.comparison.model, 'triangle');
    });
  });
}

test('pictures to fit are dropped there, or are there already; what is none is refused in words', async () => {
  await withPattern({}, async (app, page) => {
    await drop(page, '.fit', 'cheese.png', Buffer.from('cheese'));
    await page.getByRole('alert').getByText('“cheese.png” is not a picture that can be read', { exact: false }).waitFor();
    const blank = await page.evaluate(async () => {
      const canvas = new OffscreenCanvas(64, 64);
      canvas.getContext('2d').fillRect(0, 0, 64, 64);
      return [...new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer())];
    });
    await drop(page, '.fit', 'black.png', Buffer.from(blank));
    await page.getByRole('alert').getByText('“black.png” has one colour only', { exact: false }).waitFor();
    const job = await jobOf(app);
    assert.deepEqual(job.inputs, {}, 'it tells nothing about density');
    await app.openTab('Pavement');
    await app.change(() => page.getByRole('tab', { name: 'Pattern' }).click());
    await app.button('waves.png').click();
    await app.change(() => app.button('Use').click());
    const { params } = await jobOf(app);
    const { width, height } = params;
    assert.deepEqual([width, height], [1024, 1024]);
    await page.getByRole('slider', { name: 'Before and after' }).waitFor();
  });
});

test('a pattern of nothing has no statistics, and says so', async () => {
  await withPattern({}, async (app, page) => {
    await page.locator('.more summary').click();
    await app.change(() => app.set('Intensity', 0));
    await page.getByRole('button', { name: 'Statistics', exact: true }).click();
    await page.getByRole('alert').getByText('nothing to measure').waitFor();
    await app.change(() => app.button('Undo').click());
    await measured(page);
  });
});

test('noise of many cells is there soon, its other files when they are asked for', async () => {
  await withPattern({ hash: '#technique=pattern&model=gaussian&width=256&height=256' }, async (app, page) => {
    assert.equal(await app.link('Download SVG').count(), 0);
    assert.equal(piecesIn((await app.demand('SVG')).text), 65536);
    assert.equal(piecesIn((await app.demand('SVG')).text), 65536);
    await statistics(page);
    assert.deepEqual((await savedReport(app)).report, await nativeReport('measure', await app.download('PNG')));
  });
});

for (const { name, ...look } of looks) {
  test(`${name}: axe finds no serious violation on the pattern's tab`, async () => {
    await withPattern(look, async (_, page) => {
      if (name.startsWith('desktop')) await measured(page); // which is unfolded where there is room
      await checkLook(page, `pattern-${name}`);
    });
  });

  test(`${name}: axe finds no serious violation in statistics and fit`, async () => {
    await withPattern(look, async (app, page) => {
      const picture = await app.download('PNG');
      await statistics(page);
      const buffer = picture.bytes;
      await page.getByLabel('Picture to fit').setInputFiles({ name: 'cells.png', mimeType: 'image/png', buffer });
      await page.locator('.fit-result').waitFor({ state: 'attached' });
      await checkLook(page, `pattern-statistics-${name}`);
      const handle = app.button('Parameters');
      if (await handle.isVisible()) await handle.click(); // a phone
      await app.button('Use').scrollIntoViewIfNeeded();
      await checkLook(page, `pattern-fit-${name}`);
    });
  });
}
