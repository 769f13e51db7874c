// The grid of the Parquetry tab as people lay it: corners dragged, edges masked.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { closeBrowser, withApp } from './browser/app.mjs';
import { chooseAll, chooseTarget, jobOf, png, sameAsNative, target, unzip, withParquet } from './browser/boards.mjs';
import { checkLook, looks } from './browser/looks.mjs';
import { native } from './native.mjs';

after(closeBrowser);

/** The grid that is worked on, once it is at rest: `at(column, row)` is a place in mm. */
async function gridAtRest(page) {
  await page.waitForFunction(() => window.tessera.grid?.atRest);
  const grid = await page.evaluate(() => ({ ...window.tessera.grid, vertices: [...window.tessera.grid.vertices] }));
  const at = (column, row) => grid.vertices.slice(2 * (row * (grid.across + 1) + column)).slice(0, 2);
  return { ...grid, at };
}

/** A place on the target, mm, on the page. */
async function onTarget(app, [x, y]) {
  const [place] = await app.onPicture(120, 100, [[x / 72, y / 60]]);
  return place;
}

const farthest = (a, b) => Math.max(...a.map((value, i) => Math.abs(value - b[i])));
const kMorphed = '#technique=parquetry&imageSizeMm=60&patchMm=12&rotations=4&grid=morphed&minWidthMm=4';

test('a corner of the grid is dragged while the rest relaxes, and what is seen is made', async () => {
  await withParquet({ hash: kMorphed }, async (app, page, folder) => {
    // An upright edge, which draws one column of corners to itself.
    writeFileSync(join(folder, 'target.png'), png(120, 100, 0, (x) => (x < 66 ? 40 : 210)));
    await chooseAll(app, page, folder);
    await app.button('Corners').click();
    const before = await gridAtRest(page);
    assert.deepEqual([before.across, before.down], [6, 5]);
    assert.ok(before.steps > 10, `${before.steps} steps`);
    // Back to where the even grid has it: the corner inside that the edges have drawn the farthest.
    const inside = [1, 2, 3, 4].flatMap((row) => [1, 2, 3, 4, 5].map((column) => ({ column, row, to: [12 * column, 12 * row] })));
    const far = ({ column, row, to }) => farthest(before.at(column, row), to);
    const { column, row, to } = inside.reduce((best, one) => (far(one) > far(best) ? one : best));
    assert.ok(far({ column, row, to }) > 1, 'no edge has attracted any');
    const from = before.at(column, row);
    const i = 2 * (row * 7 + column);
    const seenAt = (x, y, reach) =>
      page.waitForFunction(
        ([k, u, v, most]) => {
          const { atRest, vertices } = window.tessera.grid;
          return (most > 0.01 || atRest) && Math.hypot(vertices[k] - u, vertices[k + 1] - v) < most;
        },
        [i, x, y, reach],
      );
    await page.mouse.move(...(await onTarget(app, from)));
    await page.mouse.down();
    await page.mouse.move(...(await onTarget(app, to)), { steps: 6 });
    await seenAt(...to, 0.2);
    await page.mouse.up();
    await page.locator(`.grid-pin[data-pin="${column},${row}"]`).waitFor({ state: 'attached' });
    const after = await gridAtRest(page);
    assert.ok(farthest(after.at(column, row), to) < 0.3, `${after.at(column, row)} for ${to}`);
    const others = ({ vertices }) => vertices.filter((_, k) => k !== i && k !== i + 1);
    assert.ok(farthest(others(after), others(before)) > 0.05, 'no other corner has moved');
    // Undone and redone.
    await page.keyboard.press('Control+z');
    await page.locator('.grid-pin').waitFor({ state: 'detached' });
    await seenAt(...from, 1e-9);
    assert.ok(farthest((await gridAtRest(page)).vertices, before.vertices) < 1e-9);
    await page.keyboard.press('Control+Shift+z');
    await page.locator('.grid-pin').waitFor({ state: 'attached' });
    await seenAt(...after.at(column, row), 1e-9);
    assert.ok(farthest((await gridAtRest(page)).vertices, after.vertices) < 1e-9);
    // A run begins when the tool is left; the pieces have their corners where the grid had them.
    await app.change(() => app.button('Done').click());
    const job = await app.download('job');
    const [, vertex, x, y] = /^(\d,\d):([\d.]+),([\d.]+)$/.exec(JSON.parse(job.text).params.pins);
    assert.equal(vertex, `${column},${row}`);
    assert.ok(farthest([Number(x), Number(y)], after.at(column, row)) < 1e-6);
    sameAsNative(await app.download('ZIP'), job, folder);
    native('run', join(folder, 'job.json'), '-o', join(folder, 'pieces.json'));
    const { features } = JSON.parse(readFileSync(join(folder, 'pieces.json')));
    const points = features.flatMap(({ geometry }) => geometry.coordinates.flat());
    const mm = after.heightMm / Math.max(...points.map((point) => Math.abs(point[1])));
    for (let i = 0; i < after.vertices.length; i += 2) {
      const away = points.map(([u, v]) => Math.hypot(mm * Math.abs(u) - after.vertices[i], mm * Math.abs(v) - after.vertices[i + 1]));
      assert.ok(Math.min(...away) < 0.02, `no piece has a corner at ${after.vertices[i]}, ${after.vertices[i + 1]}`);
    }
  });
});

test('corners of the grid are laid and let go by keys alone', async () => {
  await withParquet({ hash: kMorphed, reducedMotion: 'reduce' }, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    await app.button('Corners').focus();
    await page.keyboard.press('Enter');
    const before = await gridAtRest(page);
    await page.keyboard.press('ArrowRight');
    await page.getByRole('status').getByText(/^Corner 3, 2: /).waitFor();
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press(' ');
    await page.getByRole('status').getByText(/^Corner 3, 1: .*, taken up$/).waitFor();
    for (let i = 0; i < 2; ++i) await page.keyboard.press('ArrowRight');
    await page.waitForFunction((x) => window.tessera.grid.vertices[2 * 10] > x + 1, before.at(3, 1)[0]);
    await page.keyboard.press(' ');
    await page.getByRole('status').getByText(/^Corner 3, 1: .*, laid$/).waitFor();
    // One that is left is none that is laid.
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
    await page.keyboard.press('Shift+ArrowRight');
    await page.keyboard.press('Escape');
    await page.keyboard.press('ArrowUp');
    assert.equal(await page.locator('.grid-pin').count(), 1);
    await page.keyboard.press('Delete');
    await page.locator('.grid-pin').waitFor({ state: 'detached' });
    await page.waitForFunction((x) => Math.abs(window.tessera.grid.vertices[2 * 10] - x) < 1e-9, before.at(3, 1)[0]);
    await page.keyboard.press('Control+z');
    await page.locator('.grid-pin[data-pin="3,1"]').waitFor({ state: 'attached' });
    await app.change(() => app.button('Generate').click());
    assert.match((await jobOf(app)).params.pins, /^3,1:/);
    // A regular grid has no corners to lay.
    await app.change(() => page.getByRole('combobox', { name: 'Grid', exact: true }).selectOption('regular'));
    assert.equal((await jobOf(app)).params.pins, '');
    assert.equal(await app.button('Corners').count(), 0);
  });
});

test('a brush says which edges the grid follows', async () => {
  await withParquet({ hash: kMorphed }, async (app, page, folder) => {
    await chooseAll(app, page, folder);
    await app.button('Edges').click();
    const before = await gridAtRest(page);
    await app.button('Broad brush').click();
    const strokes = [];
    for (let v = 0.02; v < 1.1; v += 0.16) strokes.push([0, v], [1, v]);
    await app.drag(await app.onPicture(120, 100, strokes));
    const even = (column, row) => [12 * column, 12 * row];
    await page.waitForFunction(() => window.tessera.grid.atRest && Math.abs(window.tessera.grid.vertices[2 * 16] - 24) < 0.2);
    const masked = await gridAtRest(page);
    for (let row = 0; row <= 5; ++row)
      for (let column = 0; column <= 6; ++column) assert.ok(farthest(masked.at(column, row), even(column, row)) < 0.2);
    await app.change(() => app.button('Done').click());
    const job = await app.download('job');
    const zip = await app.download('ZIP');
    assert.equal(JSON.parse(job.text).inputs['edge-mask'], 'edge-mask.png');
    writeFileSync(join(folder, 'edge-mask.png'), unzip(zip).get('edge-mask.png'));
    sameAsNative(zip, job, folder, ['edge-mask.png']);
    await app.change(() => app.button('Undo').click());
    assert.equal((await jobOf(app)).inputs['edge-mask'], undefined);
    await app.button('Edges').click();
    assert.ok(farthest((await gridAtRest(page)).vertices, before.vertices) < 1e-9);
    await app.button('Large').click();
    await app.drag(await app.onPicture(120, 100, [[0.2, 0.5], [0.8, 0.5]]));
    await app.change(() => app.button('Done').click());
    const { inputs } = await jobOf(app);
    assert.equal(inputs['edge-mask'], 'edge-mask.png');
    // Another target has none.
    writeFileSync(join(folder, 'other.png'), target);
    await app.change(() => chooseTarget(page, join(folder, 'other.png')));
    assert.equal((await jobOf(app)).inputs['edge-mask'], undefined);
  });
});

for (const { name, ...options } of looks) {
  test(`the grid looks right and shuts nobody out: ${name}`, async () => {
    const hash = '#technique=parquetry&imageSizeMm=100&patchMm=8&rotations=4&resolutionDpi=75&grid=morphed&minWidthMm=4';
    await withApp({ isolated: true, hash, ...options }, async (app, page) => {
      await app.finished();
      const isPhone = name.startsWith('phone');
      const open = async (tool) => {
        if (isPhone) await app.button('Parameters').click();
        await app.button(tool).click();
        if (isPhone) await app.button('Parameters').click();
      };
      await open('Corners');
      await gridAtRest(page);
      const [width, height] = await page.evaluate(() => [window.tessera.grid.widthMm, window.tessera.grid.heightMm]);
      const places = await app.onPicture(width * 100, height * 100, [[0.5, 0.5], [0.53, 0.46]]);
      await page.mouse.move(...places[0]);
      await app.drag(places);
      await page.locator('.grid-pin').waitFor({ state: 'attached' });
      await gridAtRest(page);
      await checkLook(page, `parquetry-grid-${name}`);
      await open('Edges');
      await gridAtRest(page);
      await app.drag(await app.onPicture(width * 100, height * 100, [[0.1, 0.2], [0.5, 0.2]]));
      await page.waitForTimeout(500);
      await gridAtRest(page);
      await checkLook(page, `parquetry-edges-${name}`);
    });
  });
}
