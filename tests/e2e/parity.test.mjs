// tests/parity, compiled to WebAssembly, with WebGL2 in a worker of Chromium: the same tests as natively.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { launch } from './browser/chromium.mjs';
import { serve } from './browser/serve.mjs';

const here = fileURLToPath(new URL('./browser', import.meta.url));
const builds = fileURLToPath(new URL('../../build', import.meta.url));

async function runInBrowser(preset) {
  const bin = `${builds}/${preset}/bin`;
  assert.ok(existsSync(`${bin}/tessera_parity_tests.js`), `${preset} is not built`);
  const host = await serve({ '/bin/': bin, '/': here }, { isolated: true });
  const browser = await launch();
  try {
    const page = await browser.newPage();
    await page.goto(`${host.address}/parity.html`);
    await page.waitForFunction(() => typeof window.status === 'number', null, { timeout: 600_000 });
    return await page.evaluate(() => ({ status: window.status, lines: window.lines }));
  } finally {
    await browser.close();
    await host.stop();
  }
}

for (const preset of ['wasm-release', 'wasm-release-single']) {
  test(`gl and cpu agree in ${preset}`, async (t) => {
    const { status, lines } = await runInBrowser(preset);
    const output = lines.join('\n');
    t.diagnostic(lines.at(-1));
    assert.equal(status, 0, output);
    assert.match(output, /\[ {2}PASSED {2}\] \d\d+ tests/, output);
    assert.doesNotMatch(output, /SKIPPED|FAILED/, output);
  });
}
