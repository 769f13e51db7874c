// tests/parity, compiled to WebAssembly, with WebGL2 in a worker of Chromium: the same tests as natively.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { closeBrowser, withPage } from './browser/chromium.mjs';

after(closeBrowser);

const here = fileURLToPath(new URL('./browser', import.meta.url));
const builds = fileURLToPath(new URL('../../build', import.meta.url));

function runInBrowser(preset) {
  const bin = `${builds}/${preset}/bin`;
  assert.ok(existsSync(`${bin}/tessera_parity_tests.js`), `${preset} is not built`);
  return withPage({ roots: { '/bin/': bin, '/': here }, isolated: true }, async (page, host) => {
    await page.goto(`${host.address}/parity.html`);
    await page.waitForFunction(() => window.lines.some((line) => /PASSED|error:/.test(line)), null, { timeout: 400_000 });
    return await page.evaluate(() => window.lines);
  });
}

for (const preset of ['wasm-release', 'wasm-release-single']) {
  test(`gl and cpu agree in ${preset}`, async (t) => {
    const output = (await runInBrowser(preset)).join('\n');
    const ran = /(\d+) tests from \d+ test suites ran/.exec(output)?.[1];
    const passed = /\[ {2}PASSED {2}\] (\d+) tests/.exec(output)?.[1];
    t.diagnostic(`${passed} of ${ran}`);
    assert.ok(Number(ran) > 10, output);
    assert.equal(passed, ran, output);
    assert.doesNotMatch(output, /SKIPPED|FAILED/, output);
  });
}
