// The browser app's figures: what the first load weighs and takes, the longest time the page stood still while a job
// ran, and a job of each technique in Chromium beside the same one natively. Needs native-release and the built site.
//
//   node bench/app.mjs [DRAWING.png]
//   node bench/app.mjs --jobs [TECHNIQUE]...      nothing but the jobs, of all techniques or of these
//
// "Interactive" is when somebody who has just arrived can work, whether the engine is there or not: watch() below.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { brotliCompressSync } from 'node:zlib';
import { launch } from '../tests/e2e/browser/chromium.mjs';
import { serve } from '../tests/e2e/browser/serve.mjs';
import { root } from '../tests/e2e/root.mjs';

const [jobsOnly, words] = [process.argv[2] === '--jobs', process.argv.slice(2)];
const sample = (name) => join(root, 'public/samples', name);
const jobs = [
  { technique: 'pavement', inputs: { drawing: sample('waves.png') }, format: 'svg' },
  { technique: 'mosaic', inputs: { photo: sample('fruit.png') }, format: 'svg' },
  { technique: 'pebbles', inputs: { photo: sample('pebbles.png') }, format: 'glb' },
  {
    technique: 'parquetry',
    inputs: { target: sample('fruit.png'), 'panel-walnut': sample('panels/walnut.png') },
    params: { imageSizeMm: 100, patchMm: 8, rotations: 8, resolutionDpi: 75, panels: 'walnut dpi=100' }, // as in the page
    format: 'folder',
  },
];
if (!jobsOnly && words.length > 0) jobs[0].inputs.drawing = words[0];
const site = join(root, 'web/dist');
const kRuns = 7;
const kRounds = 4; // of native and Chromium in turn
const median = (values) => values.toSorted((a, b) => a - b)[Math.floor(values.length / 2)];
const say = (what, value) => console.log(`${what.padEnd(58)} ${value}`);

function weight(variant) {
  const files = readdirSync(site, { recursive: true }).filter(
    (name) =>
      /\.(js|mjs|css|html|wasm)$/.test(name) &&
      !/UTIF|sw\.js/.test(name) &&
      (!/^engine/.test(name) || name.includes(variant)),
  );
  return files.reduce((sum, name) => sum + brotliCompressSync(readFileSync(join(site, name))).length, 0);
}

/** Milliseconds of the best run, by what the native program reports: from pixels to the file's bytes. */
function native({ technique, params, inputs, format }, threads) {
  const folder = mkdtempSync(join(tmpdir(), 'tessera-'));
  const [job, report] = [join(folder, 'job.json'), join(folder, 'report.json')];
  writeFileSync(job, JSON.stringify({ schemaVersion: 1, technique, params, inputs }));
  const result = format === 'folder' ? 'pieces' : `pieces.${format}`;
  const times = Array.from({ length: kRuns }, () => {
    execFileSync(join(root, 'build/native-release/bin/tessera'), [
      ...['run', job, '-o', join(folder, result), '--backend', 'cpu', '--threads', threads, '--quiet'],
      ...['--report', report],
    ]);
    const { stages } = JSON.parse(readFileSync(report, 'utf8'));
    return stages
      .filter(({ name }) => !['decode', 'backend', 'write'].includes(name))
      .reduce((sum, { ms }) => sum + ms, 0);
  });
  rmSync(folder, { recursive: true });
  return Math.min(...times);
}

/** The same in a worker of Chromium, without the page around it. */
async function inBrowser(browser, { technique, params, inputs, format }, threads) {
  const pictures = Object.entries(inputs).map(([role, path]) => [role, readFileSync(path).toString('base64')]);
  const host = await serve(
    { '/package/': join(root, 'web/package/dist'), '/': join(root, 'bench/app') },
    { isolated: true },
  );
  const page = await browser.newPage();
  await page.goto(`${host.address}/index.html`);
  const times = await page.evaluate(
    (task) =>
      new Promise((resolve, reject) => {
        const worker = new Worker('worker.mjs', { type: 'module' });
        worker.onmessage = ({ data }) => resolve(data);
        worker.onerror = (event) => reject(new Error(event.message));
        worker.postMessage(task);
      }),
    { technique, params, pictures, format, count: kRuns + 1, threads },
  );
  await page.close();
  await host.stop();
  return Math.min(...times.slice(1));
}

/**
 * Runs in the page from its first moment. `window.figures.interactive` is the time from the start of navigation until
 * the form and the sample have been painted and a click has been answered: the frame after Cancel shows that nothing
 * runs. `restarted` is when a click on Generate after that has been answered, too, by a further frame. Answered is the
 * click, not the job, which may still wait for the engine: that is `engine`. Nothing is clicked before form, sample and
 * an enabled Generate are there.
 *
 * That the sample is there, the page's own mark tells. A pixel of the stage is read only afterwards, to see that the mark
 * tells the truth: reading it holds up a page whose graphics are drawn in software by some 300 ms.
 */
function watch() {
  window.figures = { still: [] };
  const note = (what) => (window.figures[what] ??= performance.now());
  const button = (name) => [...document.querySelectorAll('button')].find((b) => b.textContent.trim() === name);
  const runs = () => document.querySelector('[role=progressbar]').closest('[data-busy]').dataset.busy === 'true';
  const frame = () => new Promise((painted) => requestAnimationFrame(() => setTimeout(painted)));
  new PerformanceObserver((list) => {
    for (const { startTime, duration } of list.getEntries()) window.figures.still.push([startTime, duration]);
  }).observe({ type: 'longtask', buffered: true });
  const sampleShown = () =>
    ['first-contentful-paint', 'picture-shown'].every((name) => performance.getEntriesByName(name).length > 0);
  const checkSample = () => {
    const stage = document.querySelector('.stage canvas');
    const probe = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
    probe.drawImage(stage, stage.width / 2, stage.height / 2, 1, 1, 0, 0, 1, 1);
    if (probe.getImageData(0, 0, 1, 1).data[3] === 0) throw new Error('The stage is empty');
  };
  const answered = async () => {
    button('Cancel').click();
    await frame();
    if (runs()) throw new Error('Cancel was not answered');
    const answeredAt = performance.now();
    button('Generate').click();
    await frame();
    if (!runs()) throw new Error('Generate was not answered');
    window.figures.restarted = performance.now();
    checkSample();
    window.figures.interactive = answeredAt;
  };
  const look = async () => {
    const form = document.querySelector('.panel input[type=number]');
    const usable = form && button('Generate')?.disabled === false;
    if (usable && !window.figures.interactive && sampleShown()) await answered();
    if (window.tessera?.threads) note('engine');
    if (document.querySelector('a[download]')) return note('stones');
    requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

/** One visit, nothing of the site in any cache, in a browser whose own window has settled. */
async function visit(browser, host) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  const tab = await context.newPage();
  await tab.addInitScript(watch);
  await tab.waitForTimeout(2500);
  await tab.goto(host.address);
  await tab.getByRole('link', { name: 'Download PNG' }).waitFor();
  const figures = await tab.evaluate(() => window.figures);
  if (!figures.interactive) throw new Error('A click on Generate was not answered, or the stage was empty');
  const begin = await tab.evaluate(() => performance.now());
  await tab.getByRole('button', { name: 'Generate', exact: true }).click();
  await tab.waitForTimeout(100);
  await tab.getByRole('link', { name: 'Download PNG' }).waitFor();
  const still = await tab.evaluate(
    (from) => window.figures.still.filter(([at]) => at > from).map(([, ms]) => ms),
    begin,
  );
  await context.close();
  return { ...figures, still: Math.max(0, ...still) };
}

async function visits(browser) {
  const host = await serve({ '/': site }, { isolated: true });
  const all = [];
  for (let i = 0; i < kRuns; ++i) all.push(await visit(browser, host));
  await host.stop();
  const of = (figure) => all.map((one) => one[figure]).toSorted((a, b) => a - b);
  return (figure) => `${Math.round(median(of(figure)))} ms (${of(figure).map(Math.round).join(', ')})`;
}

async function firstLoad(browser) {
  for (const variant of ['threads', 'single'])
    say(`first load, ${variant}: wasm + js + css, brotli`, `${(weight(variant) / 1e6).toFixed(2)} MB`);
  const figure = await visits(browser);
  say('interactive: form, sample, a click answered', figure('interactive'));
  say('a second click, Generate, answered', figure('restarted'));
  say('engine ready', figure('engine'));
  say('first stones', figure('stones'));
  say('the page stood still at most, while a job ran (0: < 50)', figure('still'));
}

/** In turn, and the best of each: what else the machine does should not count for one of them alone. */
async function compare(browser, job, threads) {
  let [there, here] = [Infinity, Infinity];
  for (let round = 0; round < kRounds; ++round) {
    there = Math.min(there, await inBrowser(browser, job, threads));
    here = Math.min(here, native(job, threads));
  }
  say(
    `${job.technique}, ${threads} thread(s): Chromium, native, ratio`,
    `${there.toFixed(0)} ms, ${here.toFixed(0)} ms, ${(there / here).toFixed(2)}`,
  );
}

const browser = await launch();
if (!jobsOnly) await firstLoad(browser);
const asked = jobsOnly ? words.slice(1) : [];
for (const job of jobs.filter(({ technique }) => asked.length === 0 || asked.includes(technique)))
  for (const threads of [1, 2]) await compare(browser, job, threads);
await browser.close();
