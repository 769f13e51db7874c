// The browser app's figures: what the first load weighs and takes, the longest time the page stood still while a job
// ran, and a job in Chromium beside the same one natively. Needs native-release and the built site.
//
//   node bench/app.mjs [DRAWING.png]
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { brotliCompressSync } from 'node:zlib';
import { launch } from '../tests/e2e/browser/chromium.mjs';
import { root } from '../tests/e2e/browser/app.mjs';
import { serve } from '../tests/e2e/browser/serve.mjs';

const drawing = process.argv[2] ?? join(root, 'public/samples/waves.png');
const site = join(root, 'web/dist');
const kRuns = 7;
const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];
const say = (what, value) => console.log(`${what.padEnd(58)} ${value}`);

function weight(variant) {
  const files = readdirSync(site, { recursive: true }).filter(
    (name) =>
      /\.(js|mjs|css|html|wasm)$/.test(name) && !/UTIF|sw\.js/.test(name) && (!/^engine/.test(name) || name.includes(variant)),
  );
  return files.reduce((sum, name) => sum + brotliCompressSync(readFileSync(join(site, name))).length, 0);
}

/** Milliseconds of runs after the first, by what the native program reports: decoding to SVG. */
function native(threads) {
  const folder = mkdtempSync(join(tmpdir(), 'tessera-'));
  const report = join(folder, 'report.json');
  const times = Array.from({ length: kRuns }, () => {
    execFileSync(join(root, 'build/native-release/bin/tessera'), [
      ...['pave', drawing, '-o', join(folder, 'stones.svg'), '--backend', 'cpu', '--threads', threads, '--quiet'],
      ...['--report', report],
    ]);
    const { stages } = JSON.parse(readFileSync(report, 'utf8'));
    return stages.filter(({ name }) => ['fields', 'diagram', 'stones', 'format'].includes(name)).reduce((sum, { ms }) => sum + ms, 0);
  });
  rmSync(folder, { recursive: true });
  return median(times);
}

/** The same in a worker of Chromium, without the page around it. */
async function inBrowser(browser, threads) {
  const host = await serve({ '/package/': join(root, 'web/package/dist'), '/': join(root, 'bench/app') }, { isolated: true });
  const page = await browser.newPage();
  await page.goto(`${host.address}/index.html`);
  const picture = readFileSync(drawing).toString('base64');
  const times = await page.evaluate(
    ([bytes, count, workers]) =>
      new Promise((resolve, reject) => {
        const worker = new Worker('worker.mjs', { type: 'module' });
        worker.onmessage = ({ data }) => resolve(data);
        worker.onerror = (event) => reject(new Error(event.message));
        worker.postMessage({ bytes, count, threads: workers });
      }),
    [picture, kRuns + 1, threads],
  );
  await page.close();
  await host.stop();
  return median(times.slice(1));
}

async function page(browser) {
  const host = await serve({ '/': site }, { isolated: true });
  const tab = await (await browser.newContext({ viewport: { width: 1440, height: 900 } })).newPage();
  await tab.addInitScript(() => {
    window.still = [];
    new PerformanceObserver((list) => {
      for (const { startTime, duration } of list.getEntries()) window.still.push([startTime, duration]);
    }).observe({ type: 'longtask', buffered: true });
  });
  await tab.goto(host.address);
  const usable = tab.getByRole('button', { name: 'Generate', exact: true, disabled: false });
  await usable.waitFor();
  const interactive = await tab.evaluate(() => performance.now());
  await tab.getByRole('link', { name: 'Download job' }).waitFor();
  const begin = await tab.evaluate(() => performance.now());
  await usable.click();
  await tab.waitForTimeout(100);
  await tab.getByRole('link', { name: 'Download PNG' }).waitFor();
  const still = await tab.evaluate((from) => window.still.filter(([at]) => at > from).map(([, ms]) => ms), begin);
  await host.stop();
  return { interactive, still: Math.max(0, ...still) };
}

for (const variant of ['threads', 'single'])
  say(`first load, ${variant}: wasm + js + css, brotli`, `${(weight(variant) / 1e6).toFixed(2)} MB`);
const browser = await launch();
const { interactive, still } = await page(browser);
say('interactive after', `${Math.round(interactive)} ms`);
say('the page stood still at most, while a job ran', still ? `${Math.round(still)} ms` : 'below 50 ms');
for (const threads of [1, 2]) {
  const there = await inBrowser(browser, threads);
  const here = native(threads);
  say(`${threads} thread(s): Chromium, native, ratio`, `${there.toFixed(0)} ms, ${here.toFixed(0)} ms, ${(there / here).toFixed(2)}`);
}
await browser.close();
