// Whole jobs drawn with WebGL2 in a worker of Chromium, also where the context goes away in the middle.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { closeBrowser, withPage } from './browser/chromium.mjs';
import { root } from './root.mjs';

after(closeBrowser);

const roots = {
  '/package/': join(root, 'web/package/dist'),
  '/samples/': join(root, 'public/samples'),
  '/': join(root, 'tests/e2e/browser'),
};

const pave = (threads, loseAt) =>
  withPage({ roots, isolated: threads > 1 }, async (page, host) => {
    await page.goto(`${host.address}/blank.html`);
    return await page.evaluate(
      (request) =>
        new Promise((resolve, reject) => {
          const worker = new Worker('graphics_worker.mjs', { type: 'module' });
          worker.onmessage = ({ data }) => resolve(data);
          worker.onerror = (event) => reject(new Error(event.message));
          worker.postMessage(request);
        }),
      { address: '/samples/waves.png', threads, loseAt },
    );
  });

const stones = (svg) => svg.match(/class="stone"/g).length;

for (const threads of [1, 2]) {
  test(`a job drawn with WebGL2, ${threads} thread(s)`, async () => {
    const { graphics, result, warnings, svg } = await pave(threads, -1);
    assert.ok(graphics.works && graphics.software, graphics.renderer);
    assert.equal(result.backend, 'gl');
    assert.deepEqual(warnings, []);
    assert.equal(stones(svg), result.counts.stones);
    assert.ok(result.metrics.quad_fraction > 0.95);
  });

  test(`a lost context, ${threads} thread(s): the processor finishes the job`, async () => {
    const { result, warnings, svg } = await pave(threads, 2);
    assert.equal(result.backend, 'cpu');
    assert.equal(warnings.length, 1);
    assert.match(warnings[0], /processor takes over/);
    assert.equal(stones(svg), result.counts.stones);
  });
}
