// The browser app as people use it, with threads (isolated) and without (a plain static host).
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { closeBrowser, withApp } from './browser/app.mjs';
import { checkLook, looks } from './browser/looks.mjs';
import { inFolder, nativeSvg } from './native.mjs';
import { root } from './root.mjs';
import { assertSameStones } from './same_stones.mjs';

after(closeBrowser);

const sample = (name) => join(root, 'public/samples', `${name}.png`);
const ownDrawings = [sample('ornament'), sample('tiles')];
const realDrawing = join(root, '../shared/data/pavement/butterfly.png');

for (const isolated of [true, false]) {
  const build = isolated ? 'threads' : 'single';

  test(`${build}: a picture in, files out, the same as the native program's`, async (t) => {
    if (!existsSync(realDrawing)) t.diagnostic('without a real drawing: ../shared is not here');
    const pictures = existsSync(realDrawing) ? [...ownDrawings, realDrawing] : ownDrawings;
    await withApp({ isolated }, async (app) => {
      await app.finished(); // the sample that is running on arrival
      assert.equal((await app.threads()) > 1, isolated);
      for (const picture of pictures) {
        await app.open(picture);
        await app.running();
        await app.finished();
        const svg = await app.download('SVG');
        const job = await app.download('job');
        assert.match(svg.name, /\.svg$/);
        assert.match((await app.download('DXF')).text, /^\s*0\r?\nSECTION[\s\S]*EOF\s*$/);
        assert.ok((await app.download('PNG')).text.length > 1000);
        await inFolder((folder) => assertSameStones(svg.text, nativeSvg(folder, job.text, { drawing: readFileSync(picture) })));
      }
      await app.button('More downloads').click();
      assert.ok((await app.demand('animation')).bytes.includes('acTL'));
    });
  });

  test(`${build}: cancel stops a run within 200 ms, and the next one works`, async (t) => {
    await withApp({ isolated }, async (app, page) => {
      await app.finished();
      await app.set('Iterations', 1000);
      const times = [];
      for (let i = 0; i < 3; ++i) {
        await app.button('Generate').click();
        await app.running();
        await page.waitForFunction(() => document.querySelector('[role=progressbar]').ariaValueNow > 5);
        times.push(
          await page.evaluate(async () => {
            const bar = document.querySelector('[role=progressbar]').closest('[data-busy]');
            const begin = performance.now();
            [...document.querySelectorAll('button')].find((b) => b.textContent.trim() === 'Cancel').click();
            while (bar.dataset.busy === 'true') await new Promise((next) => setTimeout(next));
            return performance.now() - begin;
          }),
        );
      }
      t.diagnostic(`cancelled after ${times.map(Math.round).join(', ')} ms`);
      assert.ok(Math.min(...times) <= 200, String(times));
      await app.set('Iterations', 2);
      await app.finished();
    });
  });

  test(`${build}: a wrong file is told and changes nothing`, async () => {
    await inFolder(async (folder) => {
      const wrong = join(folder, '<b>no picture<.png');
      writeFileSync(wrong, 'this is no picture');
      await withApp({ isolated }, async (app, page) => {
        await app.finished();
        await app.open(wrong);
        const alert = page.getByRole('alert');
        await alert.waitFor();
        assert.match(await alert.textContent(), /<b>no picture<\.png/);
        await app.openJob(wrong);
        await page.getByRole('alert').waitFor();
        await app.generate();
        assert.equal(await page.getByRole('alert').count(), 0);
      });
    });
  });

  test(`${build}: a job is opened again, from JSON and from an SVG`, async () => {
    await inFolder(async (folder) => {
      await withApp({ isolated }, async (app) => {
        await app.finished();
        await app.set('Half side', 7);
        await app.running();
        await app.finished();
        for (const kind of ['job', 'SVG']) {
          const { name, text } = await app.download(kind);
          const before = JSON.parse((await app.download('job')).text);
          assert.equal(before.params.halfSide, 7);
          writeFileSync(join(folder, name), text);
          await app.button('Coarse').click();
          await app.running();
          await app.finished();
          assert.notEqual(JSON.parse((await app.download('job')).text).params.halfSide, 7);
          await app.openJob(join(folder, name));
          await app.running();
          await app.finished();
          assert.deepEqual(JSON.parse((await app.download('job')).text).params, before.params);
        }
      });
    });
  });
}

const noThreads = { '**/tessera-threads.mjs': 'export default () => Promise.reject(new Error("no threads today"));' };

test('where the engine with threads cannot start, the one without takes over', async () => {
  await withApp({ isolated: true, scripts: noThreads }, async (app, page) => {
    await app.finished();
    assert.equal(await app.threads(), 1);
    assert.equal(await page.evaluate(() => window.tessera.isolated), true);
    assert.equal(await page.getByRole('alert').count(), 0);
    await app.generate();
  });
});

test('parameters are undone, redone and kept in the address', async () => {
  await withApp({ isolated: true }, async (app, page) => {
    await app.finished();
    const halfSide = page.getByRole('spinbutton', { name: 'Half side' });
    await app.set('Half side', 9);
    await app.finished();
    await page.keyboard.press('Escape');
    await page.locator('body').click({ position: { x: 5, y: 5 } });
    await page.keyboard.press('Control+z');
    assert.equal(await halfSide.inputValue(), '4');
    await page.keyboard.press('Control+Shift+z');
    assert.equal(await halfSide.inputValue(), '9');
    await app.finished();
    await page.reload();
    await app.finished();
    assert.equal(await halfSide.inputValue(), '9');
    assert.equal(JSON.parse((await app.download('job')).text).params.halfSide, 9);
  });
});

test('the page can be used before the engine is there', async () => {
  await withApp({ isolated: true }, async (app, page) => {
    let release;
    const held = new Promise((go) => (release = go));
    await page.route('**/*.wasm', async (route) => {
      await held;
      await route.continue();
    });
    await page.reload();
    const bar = page.locator('.bar');
    await bar.getByText('Loading the engine').waitFor(); // the sample waits for it
    await app.button('Cancel').click();
    await bar.getByText('Cancelled').first().waitFor();
    await app.set('Half side', 9);
    await app.set('Half side', 7);
    await app.button('Generate').click();
    await bar.getByText('Loading the engine').waitFor();
    assert.equal(await app.threads(), 0);
    release();
    await app.finished();
    assert.equal(JSON.parse((await app.download('job')).text).params.halfSide, 7);
  });
});

test('a value out of range is told at its field', async () => {
  await withApp({ isolated: true }, async (app, page) => {
    await app.finished();
    await app.set('Stretch min', 5); // larger than stretchMax
    await page.getByText(/expected at most stretchMax/).first().waitFor();
    await app.set('Stretch min', 0.5);
    await app.running();
    await app.finished();
  });
});

test('the main path by keyboard alone', async () => {
  await withApp({ isolated: true }, async (app, page) => {
    await app.finished();
    const focused = () => page.evaluate(() => document.activeElement?.textContent?.trim() ?? '');
    const tabTo = async (name) => {
      for (let i = 0; i < 80 && (await focused()) !== name; ++i) await page.keyboard.press('Tab');
      assert.equal(await focused(), name);
    };
    await tabTo('Ornament');
    await page.keyboard.press('Enter');
    await app.running();
    await app.finished();
    await tabTo('SVG');
    const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);
    assert.match(download.suggestedFilename(), /ornament.*\.svg$/);
  });
});

test('works without a network after the first load', async () => {
  for (const isolated of [true, false]) {
    await withApp({ isolated }, async (app, page) => {
      await app.finished();
      await page.evaluate(async () => void (await navigator.serviceWorker.ready));
      await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
      await app.host.stop();
      await page.reload();
      await app.finished();
      assert.ok((await app.threads()) > 1, 'the second load is isolated by the service worker');
      await app.generate();
    });
  }
});

/** The script of the engine without threads, which also shows the worker's global scope its memory. */
const showingMemory = () => `
  const instantiate = WebAssembly.instantiate;
  WebAssembly.instantiate = async (...words) => {
    const made = await instantiate(...words);
    const { exports } = made.instance ?? made;
    globalThis.engineMemory = Object.values(exports).find((value) => value instanceof WebAssembly.Memory);
    return made;
  };
  ${readFileSync(join(root, 'web/dist/engine/tessera-single.mjs'), 'utf8')}`;

test('twenty jobs in a row need no more memory than the first ones', async (t) => {
  // Threads that wait do not answer, and Chromium, asked for all memory, gives up on them only after a minute.
  const scripts = { ...noThreads, '**/tessera-single.mjs': showingMemory() };
  await withApp({ isolated: true, scripts }, async (app, page) => {
    await app.finished();
    const engine = page.workers().find((worker) => /engine\.worker/.test(worker.url()));
    const memory = async () => ({
      page: await page.evaluate(async () => (await performance.measureUserAgentSpecificMemory()).bytes),
      engine: await engine.evaluate(() => globalThis.engineMemory.buffer.byteLength),
    });
    const one = async (i) => {
      await app.set('Seed', 100 + i);
      await app.running();
      await app.finished();
    };
    for (let i = 0; i < 3; ++i) await one(i);
    const before = await memory();
    for (let i = 3; i < 23; ++i) await one(i);
    const after = await memory();
    for (const part of ['page', 'engine']) {
      t.diagnostic(`${part}: ${(before[part] / 1e6).toFixed(1)} MB, then ${(after[part] / 1e6).toFixed(1)} MB`);
      assert.ok(after[part] <= 1.1 * before[part], `${part}: ${before[part]} bytes became ${after[part]}`);
    }
  });
});

for (const { name, ...look } of looks) {
  test(`${name}: axe finds no serious violation`, async () => {
    await withApp({ isolated: true, ...look }, async (app, page) => {
      await app.finished();
      await checkLook(page, `pavement-${name}`);
    });
  });
}
