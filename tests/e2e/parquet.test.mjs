// The Parquetry tab as people use it: a target and scans of wood in, cut files out.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { after, test } from 'node:test';
import { closeBrowser, withApp } from './browser/app.mjs';
import {
  chooseAll,
  choosePanels,
  chooseTarget,
  elm,
  grain,
  jobOf,
  oak,
  png,
  rowsOf,
  sameAsNative,
  target,
  unzip,
  withParquet,
} from './browser/boards.mjs';
import { checkLook, looks } from './browser/looks.mjs';
import { native } from './native.mjs';

after(closeBrowser);

for (const isolated of [true, false]) {
  const build = isolated ? 'threads' : 'single';

  test(`${build}: a folder of cut files, the same as the native program's`, async () => {
    await withParquet({ isolated }, async (app, page, folder) => {
      assert.equal((await app.threads()) > 1, isolated);
      await chooseAll(app, page, folder);
      const job = await app.download('job');
      const zip = await app.download('ZIP');
      assert.equal(zip.name, 'target-parquetry.zip');
      assert.deepEqual(JSON.parse(job.text).inputs, {
        target: 'target.png',
        'panel-oak': 'oak.png',
        'panel-elm': 'elm.png',
      });
      const files = sameAsNative(zip, job, folder);
      assert.deepEqual(JSON.parse(files.get('job.json')), JSON.parse(job.text));
      const report = JSON.parse(files.get('report.json'));
      const nativeReport = JSON.parse(readFileSync(join(folder, 'out/report.json')));
      assert.deepEqual(report.counts, nativeReport.counts);
      assert.deepEqual(report.metrics, nativeReport.metrics);
      const sums = ({ inputs }) => inputs.map(({ path, width, height, sha256 }) => [basename(path), width, height, sha256]).sort();
      assert.deepEqual(sums(report), sums(nativeReport));
      const written = ({ outputs }) =>
        outputs
          .map(({ path, bytes, sha256 }) => [basename(path), bytes, sha256])
          .filter(([name]) => /\.(csv|png|dxf)$/.test(name))
          .sort();
      assert.deepEqual(written(report), written(nativeReport));
      const told = await page.locator('.bar-text strong').textContent();
      assert.equal(told, `${rowsOf(files.get('pieces.csv')).length} pieces`);
    });
  });
}

test('pieces of any shape are the same as the native program\'s', async () => {
  for (const shape of ['grid=morphed&minWidthMm=4', 'seams=g1', 'posterize=3'])
    await withParquet({ hash: `#technique=parquetry&imageSizeMm=60&patchMm=12&rotations=4&${shape}` }, async (app, page, folder) => {
      await chooseAll(app, page, folder);
      const files = sameAsNative(await app.download('ZIP'), await app.download('job'), folder);
      assert.ok(rowsOf(files.get('pieces.csv')).length > 4, shape);
    });
});

test('pieces come one after the other, and a run is cancelled', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    await app.set('Patch mm', 5);
    await app.set('Rotations', 120);
    await page.waitForFunction(() => {
      const cuts = [...document.querySelectorAll('.wood-sheet')].map((sheet) => Number(sheet.dataset.cuts));
      const count = cuts.reduce((sum, n) => sum + n, 0);
      return document.querySelector('.bar[data-busy=true]') && count > 5 && count < 150;
    });
    await app.button('Cancel').click();
    await page.getByText('Cancelled', { exact: true }).first().waitFor();
    await page.locator('.bar[data-busy=false]').waitFor();
    await app.set('Rotations', 4);
    await app.finished();
    assert.equal(JSON.parse((await app.download('job')).text).params.rotations, 4);
  });
});

test('a piece is pointed at on the picture and on the wood', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    const rows = rowsOf(unzip(await app.download('ZIP')).get('pieces.csv'));
    const [place] = await app.onPicture(120, 100, [[0.5 / 7, 0.5 / 6]]);
    await page.mouse.move(...place);
    await page.locator('.piece-label').getByText('A1', { exact: true }).waitFor();
    const [, , , , panel] = rows.find(([id]) => id === 'A1');
    await page.locator(`.wood-sheet[data-panel=${panel}] .wood-chosen`).waitFor();
    // And the other way around: the middle of a piece on its board.
    const [id, , , , board, x, y] = rows.at(-1);
    const box = await page.locator(`.wood-sheet[data-panel=${board}] svg`).boundingBox();
    const scale = Math.min(box.width / 162.56, box.height / 121.92);
    const [left, top] = [box.x + (box.width - 162.56 * scale) / 2, box.y + (box.height - 121.92 * scale) / 2];
    await page.mouse.move(left + Number(x) * scale, top + Number(y) * scale);
    await page.locator('.piece-label').getByText(id, { exact: true }).waitFor();
    await page.locator('.wood-label').getByText(id, { exact: true }).waitFor();
    assert.equal(await page.locator('.chosen-piece path').count(), 1);
    await page.mouse.move(5, 5);
    await page.locator('.piece-label').waitFor({ state: 'detached' });
    // Keys alone.
    await page.locator('.stage-canvas').focus();
    await page.keyboard.press('n');
    await page.locator('.wood-label').getByText(rows[0][0], { exact: true }).waitFor();
    await page.keyboard.press('b');
    await page.locator('.wood-label').getByText(id, { exact: true }).waitFor();
    await page.keyboard.press('Escape');
    await page.locator('.wood-label').waitFor({ state: 'hidden' });
  });
});

test('a dot goes along the cuts, but not for those who want no motion', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    await app.button('Cut').click();
    const dot = page.locator('.wood-sheet[data-panel=oak] .laser');
    const at = () => dot.evaluate((circle) => circle.getBoundingClientRect().x);
    const before = await at();
    await page.waitForFunction((x) => document.querySelector('[data-panel=oak] .laser').getBoundingClientRect().x !== x, before);
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await dot.waitFor({ state: 'detached' });
    assert.equal(await app.button('Cut').count(), 0);
  });
});

test('panels have names, resolutions and masks; what was changed is undone', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    await app.change(async () => {
      await page.getByLabel('Name of oak').fill('my oak');
      await page.getByLabel('Name of oak').press('Enter');
    });
    assert.ok('panel-my-oak' in JSON.parse((await app.download('job')).text).inputs);
    await app.change(() => page.getByLabel('Resolution of elm, dpi').fill('100'));
    assert.equal(JSON.parse((await app.download('job')).text).params.panels, 'elm dpi=100');
    // Wood on the left half only.
    writeFileSync(join(folder, 'half.png'), png(320, 240, 0, (x) => (x < 160 ? 255 : 0)));
    await app.change(() => page.getByLabel('Mask of my-oak').setInputFiles(join(folder, 'half.png')));
    const rows = rowsOf(unzip(await app.download('ZIP')).get('pieces.csv'));
    const onOak = rows.filter((row) => row[4] === 'my-oak');
    assert.ok(onOak.length > 0);
    assert.ok(onOak.every((row) => Number(row[5]) < 81.3), 'cut where there is no wood');
    await app.change(() => app.button('Remove elm').click());
    assert.equal(JSON.parse((await app.download('job')).text).inputs['panel-elm'], undefined);
    await app.change(() => app.button('Undo').click());
    assert.equal(JSON.parse((await app.download('job')).text).params.panels, 'elm dpi=100');
  });
});

/** A place of a scan of 320 x 240 px, on the page. */
async function onScan(page, panel, x, y) {
  const box = await page.locator(`.wood-sheet[data-panel=${panel}] .scan-tool`).boundingBox();
  return [box.x + (x / 320) * box.width, box.y + (y / 240) * box.height];
}


test('masks are found, and corrected with a brush', async () => {
  await withParquet({}, async (app, page, folder) => {
    // A board on a bright, even lid.
    const onLid = (x, y) => x < 20 || y < 20 || x >= 300 || y >= 220;
    const lid = png(320, 240, 50, (x, y) => (onLid(x, y) ? 250 + (((x * 31 + y * 17) ^ (x * y)) % 3) : grain(x, y, 0) * 0.8));
    writeFileSync(join(folder, 'board.png'), lid);
    await app.change(() => chooseTarget(page, join(folder, 'target.png')));
    await app.change(() => choosePanels(page, join(folder, 'board.png')));
    await app.button('Mask').click();
    const shaded = (x, y) =>
      page.evaluate(
        async ([u, v]) => {
          const image = new Image();
          image.src = document.querySelector('.wood-sheet mask image').getAttribute('href');
          await image.decode();
          const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
          context.drawImage(image, 0, 0);
          return context.getImageData(u * image.width, v * image.height, 1, 1).data[3] > 0;
        },
        [x / 320, y / 240],
      );
    assert.deepEqual(await Promise.all([shaded(5, 5), shaded(160, 120), shaded(310, 120)]), [true, false, true]);
    // The right half is no wood.
    await app.button('Broad brush').click();
    const places = [];
    for (let y = 10; y < 240; y += 30) places.push(await onScan(page, 'board', y % 60 === 10 ? 190 : 310, y), await onScan(page, 'board', y % 60 === 10 ? 310 : 190, y));
    await app.change(() => app.drag(places));
    const files = unzip(await app.download('ZIP'));
    const rows = rowsOf(files.get('pieces.csv'));
    assert.ok(rows.length > 0);
    assert.ok(rows.every((row) => Number(row[5]) < (170 * 25.4) / 50), 'cut where there is no wood');
    // The job and the mask that comes with it make the same elsewhere.
    const job = await app.download('job');
    assert.equal(JSON.parse(job.text).inputs['mask-board'], 'board-mask.png');
    writeFileSync(join(folder, 'board-mask.png'), files.get('board-mask.png'));
    writeFileSync(join(folder, 'job.json'), job.text);
    native('run', join(folder, 'job.json'), '-o', join(folder, 'out/'));
    assert.equal(readFileSync(join(folder, 'out/pieces.csv'), 'utf8'), files.get('pieces.csv').toString());
    await app.change(() => app.button('Undo stroke').click());
    assert.equal((await jobOf(app)).inputs['mask-board'], undefined);
    // By keys alone.
    await app.button('Mask').click();
    await app.button('Mask').click();
    await page.locator('.scan-tool').focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press(' ');
    for (let i = 0; i < 3; ++i) await page.keyboard.press('Shift+ArrowRight');
    await page.locator('.scan-stroke').waitFor({ state: 'attached' });
    await app.change(() => page.keyboard.press(' '));
    assert.equal((await jobOf(app)).inputs['mask-board'], 'board-mask.png');
    await page.locator('.scan-tool').focus();
    await page.keyboard.press('Escape');
    await page.locator('.scan-tool').waitFor({ state: 'detached' });
  });
});

test('marks are found, confirmed, added and removed', async () => {
  await withParquet({}, async (app, page, folder) => {
    const middles = [[40, 40], [280, 40], [280, 200]];
    const disc = (x, y) => middles.some(([u, v]) => Math.hypot(x + 0.5 - u, y + 0.5 - v) < 6);
    writeFileSync(join(folder, 'marked.png'), png(320, 240, 50, (x, y) => (disc(x, y) ? 15 : 190 + grain(x, y, 0) / 9)));
    await app.change(() => chooseTarget(page, join(folder, 'target.png')));
    await app.change(() => choosePanels(page, join(folder, 'marked.png')));
    await page.getByText('3 marks').waitFor();
    await app.button('Marks').click();
    await app.change(() => app.button('Confirm marks').click());
    const marks = async () => /marks=(\S+)/.exec((await jobOf(app)).params.panels)?.[1];
    const found = (await marks()).split(',').map((pair) => pair.split(':').map(Number));
    assert.equal(found.length, 3);
    found.forEach(([x, y], i) => assert.ok(Math.hypot(x - middles[i][0], y - middles[i][1]) < 1, `${x} ${y}`));
    await app.change(async () => page.mouse.click(...(await onScan(page, 'marked', 100, 120))));
    const more = (await marks()).split(',');
    assert.equal(more.length, 4);
    const [x, y] = more[3].split(':').map(Number);
    assert.ok(Math.hypot(x - 100, y - 120) < 2, more[3]);
    const fiducials = unzip(await app.download('ZIP')).get('panel-marked.cut.svg').toString().match(/ id="mark-\d+"/g);
    assert.equal(fiducials.length, 4);
    for (const [u, v] of [...middles, [100, 120]])
      await app.change(async () => page.mouse.click(...(await onScan(page, 'marked', u, v))));
    assert.equal(await marks(), 'none');
    await app.change(() => app.button('Find marks').click());
    assert.equal(await marks(), undefined);
    await page.getByText('3 marks').waitFor();
  });
});

test('a file gives the shapes of the pieces', async () => {
  await withParquet({ hash: '#technique=parquetry&imageSizeMm=60&patchMm=12&rotations=4&posterize=3' }, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    const choose = (name) => page.getByLabel('Segmentation', { exact: true }).setInputFiles(join(folder, name));
    writeFileSync(join(folder, 'halves.png'), png(60, 50, 0, (x, y) => (x < 20 ? 0 : y < 25 ? 90 : 200)));
    writeFileSync(
      join(folder, 'drawing.svg'),
      '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 120 100"><rect width="60" height="100"/><circle cx="90" cy="50" r="24"/></svg>',
    );
    writeFileSync(join(folder, 'open.svg'), '<svg viewBox="0 0 120 100"><path d="M0 0L10 0L10 10"/></svg>');
    writeFileSync(join(folder, 'wide.png'), png(90, 50, 0, () => 3));
    for (const [name, pieces] of [['halves.png', 3], ['drawing.svg', 4]]) {
      await app.change(() => choose(name));
      const job = await app.download('job');
      assert.equal(JSON.parse(job.text).inputs.segmentation, name);
      assert.equal(JSON.parse(job.text).params.posterize, 0);
      const files = sameAsNative(await app.download('ZIP'), job, folder);
      assert.ok(rowsOf(files.get('pieces.csv')).length >= pieces - 1);
      const inputsOf = (report) => JSON.parse(report).inputs.map(({ path, width, height, sha256 }) => [basename(path), width, height, sha256]).sort();
      assert.deepEqual(inputsOf(files.get('report.json')), inputsOf(readFileSync(join(folder, 'out/report.json'))));
    }
    // What does not fit is told, and changes nothing.
    await choose('open.svg');
    await page.getByRole('alert').getByText(/open\.svg.* closed/).waitFor();
    await choose('wide.png');
    await page.getByRole('alert').getByText(/wide\.png.* is 90 × 50, expected the proportions of the target, 120 × 100/).waitFor();
    await app.generate();
    assert.equal((await jobOf(app)).inputs.segmentation, 'drawing.svg');
    await app.change(() => app.button('Remove segmentation').click());
    assert.equal((await jobOf(app)).inputs.segmentation, undefined);
    await app.change(() => app.button('Undo').click());
    assert.equal((await jobOf(app)).inputs.segmentation, 'drawing.svg');
  });
});

test('what only the cut files take is not matched again', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    const told = async () => {
      const files = unzip(await app.download('ZIP'));
      return { rows: files.get('pieces.csv').toString(), report: JSON.parse(files.get('report.json')) };
    };
    const before = await told();
    const matched = ({ report }) => report.stages.some(({ name }) => name === 'matching');
    assert.ok(matched(before));
    await page.locator('.more summary').click();
    await app.change(() => app.set('Cut speed', 5));
    const after = await told();
    assert.equal(matched(after), false);
    assert.equal(after.rows, before.rows);
    assert.ok(Math.abs(after.report.metrics.cut_minutes / before.report.metrics.cut_minutes - 4) < 1e-9);
    await app.change(() => app.set('Kerf mm', 0.6));
    assert.ok(matched(await told()));
    await app.change(() => app.set('Copies', 2));
    const files = unzip(await app.download('ZIP'));
    assert.ok(files.has('preview-2.png'));
    assert.match(files.get('pieces.csv').toString(), /^2-A1,/m);
  });
});

test("a scan's opacity is its mask", async () => {
  await withParquet({}, async (app, page, folder) => {
    const half = png(320, 240, 50, (x, y) => grain(x, y, 0), (x) => (x < 160 ? 255 : 0));
    writeFileSync(join(folder, 'half.png'), half);
    await app.change(() => chooseTarget(page, join(folder, 'target.png')));
    await app.change(() => choosePanels(page, join(folder, 'half.png')));
    const rows = rowsOf(unzip(await app.download('ZIP')).get('pieces.csv'));
    assert.ok(rows.length > 0);
    assert.ok(rows.every((row) => Number(row[5]) < 81.3));
  });
});

test('a result is improved for some seconds, and the job says how often that was tried', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    await app.change(async () => {
      await page.getByRole('spinbutton', { name: 'Improve for' }).fill('1');
      await page.getByRole('spinbutton', { name: 'Improve for' }).press('Enter');
    });
    const job = await app.download('job');
    const tries = JSON.parse(job.text).params.improveTries;
    assert.ok(tries > 0, `${tries} tries`);
    const files = sameAsNative(await app.download('ZIP'), job, folder);
    const report = JSON.parse(files.get('report.json'));
    assert.ok(report.metrics.cost <= report.metrics.greedy_cost);
    assert.equal(report.params.improveTries, tries);
    assert.deepEqual(report.metrics, JSON.parse(readFileSync(join(folder, 'out/report.json'))).metrics);
  });
});

test('several targets are made of the same wood', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    writeFileSync(join(folder, 'tall.png'), png(50, 90, 0, (x, y) => 2 * y + x));
    writeFileSync(join(folder, 'broken.png'), 'no picture');
    await app.change(() =>
      page.getByLabel('More', { exact: true }).setInputFiles([join(folder, 'tall.png'), join(folder, 'broken.png')]),
    );
    await page.getByRole('alert').getByText(/broken.png.* is not a picture/).waitFor();
    const job = await app.download('job');
    assert.equal(JSON.parse(job.text).inputs['target-2'], 'tall.png');
    const files = sameAsNative(await app.download('ZIP'), job, folder);
    assert.ok(files.has('preview-2.png'));
    assert.match(await page.locator('.bar-text').textContent(), /2 targets/);
    // Both are on the stage: a piece of the second is pointed at. The first is 72 x 60 mm, the second 60 x 108.
    const [place] = await app.onPicture(132, 108, [[(72 + 30) / 132, 100 / 108]]);
    await page.mouse.move(...place);
    await page.locator('.piece-label').getByText(/^2-[A-F]1[01]$/).waitFor();
    await app.change(() => app.button('Remove tall.png').click());
    assert.equal((await jobOf(app)).inputs['target-2'], undefined);
    await app.change(() => app.button('Undo').click());
    assert.equal((await jobOf(app)).inputs['target-2'], 'tall.png');
  });
});

test('a forecast comes first, and wood that runs out is told', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    const forecast = page.getByRole('list', { name: 'Forecast' });
    await forecast.getByText('The wood suffices').waitFor();
    await app.set('Image size', 200);
    await forecast.getByText(/does not suffice/).waitFor();
    await page.getByRole('alert').getByText(/no wood is left for \d+ of \d+ patches/).waitFor();
    await app.finished();
    assert.match(await page.locator('.bar-text').textContent(), /without wood/);
  });
});

test('what is wrong is told, and everything stays', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    writeFileSync(join(folder, 'broken.png'), 'no picture');
    await choosePanels(page, join(folder, 'broken.png'));
    await page.getByRole('alert').getByText(/broken.png.* is not a picture/).waitFor();
    assert.equal(await page.locator('.wood-sheet').count(), 2);
    await page.getByLabel('Mask of oak').setInputFiles(join(folder, 'target.png'));
    await page.getByRole('alert').getByText(/oak has a mask of 120 x 100 px/).waitFor();
    await app.change(() => app.button('Undo').click());
    await app.set('Patch mm', 3);
    await page.getByText(/is less than minWidthMm/).first().waitFor();
    await app.change(() => app.set('Patch mm', 12));
    await app.button('Remove oak').click();
    await app.button('Remove elm').click();
    await page.getByRole('alert').getByText('A panel of wood is missing').waitFor();
    await app.change(() => app.button('Undo').click());
  });
});

test('a job is opened again', async () => {
  await withParquet({}, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    const job = await app.download('job');
    writeFileSync(join(folder, 'job.json'), job.text);
    await app.change(() => app.set('Patch mm', 15));
    await app.change(() => app.openJob(join(folder, 'job.json')));
    assert.deepEqual(JSON.parse((await app.download('job')).text), JSON.parse(job.text));
    assert.equal(await page.getByRole('alert').count(), 0);
    await page.goto(`${app.host.address}#technique=parquetry&imageSizeMm=60&patchMm=15&rotations=4`);
    await page.reload();
    await app.finished();
    await app.openJob(join(folder, 'job.json'));
    await page.getByRole('alert').getByText(/“elm.png” and “oak.png”/).waitFor();
  });
});

test('the first visit sees its sample grow, by keys alone', async () => {
  await withApp({ isolated: true, hash: '' }, async (app, page) => {
    await app.finished();
    await page.getByRole('tab', { name: 'Pavement' }).focus();
    await page.keyboard.press('End');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => Number(document.querySelector('.wood-sheet')?.dataset.cuts) > 5);
    await app.finished();
    assert.match(await page.locator('.bar-text strong').textContent(), /^\d+ pieces$/);
    assert.ok((await app.download('ZIP')).bytes.length > 10_000);
  });
});

for (const { name, ...options } of looks) {
  test(`looks right and has nothing that shuts people out: ${name}`, async () => {
    await withApp({ isolated: true, hash: '#technique=parquetry&imageSizeMm=100&patchMm=8&rotations=8', ...options }, async (app, page) => {
      await app.finished();
      await page.locator(name.startsWith('phone') ? '.half-switch' : '.wood-sheet image').first().waitFor();
      await page.locator('.stage-canvas').focus();
      for (let i = 0; i < 40; ++i) await page.keyboard.press('n');
      await page.waitForTimeout(400); // until the stage has drawn
      await checkLook(page, `parquetry-${name}`);
      if (!name.startsWith('phone')) return;
      await page.getByRole('button', { name: 'Wood', exact: true }).click();
      await checkLook(page, `parquetry-wood-${name}`);
    });
  });
}
