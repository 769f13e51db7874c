// The app as a user meets it: a page in Chromium, what it says and does, and what must never happen on it.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { root } from '../root.mjs';
import { withPage } from './chromium.mjs';

export { closeBrowser } from './chromium.mjs';

const roots = { '/': `${root}/web/dist` };
const patience = { timeout: 120_000 };
const kViewport = { width: 1240, height: 720 }; // a processor draws here: with more pixels everything takes longer

/**
 * Opens the app and hands it to `use`; afterwards there may be no complaint on its console and no request abroad.
 * `scripts`: what the page gets in the place of the site's, by their addresses.
 */
export const withApp = ({ isolated, viewport = kViewport, hash = '', scripts = {}, ...options }, use) =>
  withPage({ roots, isolated, viewport, acceptDownloads: true, ...options }, async (page, host) => {
    const complaints = [];
    for (const [address, body] of Object.entries(scripts))
      await page.context().route(address, (route) => route.fulfill({ contentType: 'text/javascript', body }));
    page.context().on('request', (request) => {
      if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(host.address))
        complaints.push(`a request to ${request.url()}`);
    });
    page.setDefaultTimeout(patience.timeout);
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
    });
    page.on('pageerror', (error) => complaints.push(String(error)));
    await page.goto(`${host.address}${hash}`);
    await use(new App(page, host), page);
    assert.deepEqual(complaints, []);
  });

class App {
  constructor(page, host) {
    this.page = page;
    this.host = host;
  }

  button(name) {
    return this.page.getByRole('button', { name, exact: true });
  }

  link(name) {
    return this.page.getByRole('link', { name, exact: true });
  }

  /** Until the run that goes on is done and every file of it is there. */
  async finished() {
    await this.link('Download PNG').waitFor(patience);
    await this.link('Download job').waitFor(patience);
  }

  /** Until a run goes on. */
  async running() {
    await this.page.waitForFunction(
      () => document.querySelector('[role=progressbar]').closest('[data-busy=true]') !== null,
    );
  }

  /** Does `act`, until another run than before is done; most are over before one could see them going on. */
  async change(act) {
    const link = this.link('Download job');
    const before = (await link.count()) ? await link.getAttribute('href') : '';
    await act();
    await this.page.waitForFunction((old) => {
      const now = document.querySelector('a[aria-label="Download job"]');
      return now && now.getAttribute('href') !== old;
    }, before);
    await this.finished();
  }

  /** Another technique, with the sample that it begins with done. */
  async openTab(name) {
    await this.page.getByRole('tab', { name, exact: true }).click();
    await this.running();
    await this.finished();
  }

  async open(path) {
    await this.page.getByLabel('Image', { exact: true }).setInputFiles(path);
  }

  async openJob(path) {
    await this.page.getByLabel('Open job').setInputFiles(path);
  }

  async generate() {
    await this.button('Generate').click();
    await this.finished();
  }

  async set(field, value) {
    const input = this.page.getByRole('spinbutton', { name: field });
    await input.fill(String(value));
    await input.press('Enter');
  }

  /** The file behind a download link. */
  download(kind) {
    return this.downloadBy(this.link(`Download ${kind}`));
  }

  /** A file that is made when it is asked for. */
  demand(kind) {
    return this.downloadBy(this.button(`Download ${kind}`));
  }

  async downloadBy(control) {
    const [download] = await Promise.all([this.page.waitForEvent('download'), control.click()]);
    const bytes = await readFile(await download.path());
    return { name: download.suggestedFilename(), bytes, text: bytes.toString('utf8') };
  }

  /** Places on the picture, as parts of it, in pixels of the page. The picture lies fitted and centred on the stage. */
  async onPicture(width, height, places) {
    const box = await this.page.locator('.stage-canvas').boundingBox();
    const margin = box.width < 600 ? 16 : 48;
    const scale = Math.min((box.width - margin) / width, (box.height - margin) / height, 4);
    return places.map(([u, v]) => [
      box.x + box.width / 2 + (u - 0.5) * width * scale,
      box.y + box.height / 2 + (v - 0.5) * height * scale,
    ]);
  }

  /** Until the field in three dimensions shows the stones of the run that is done. */
  async fieldShown() {
    await this.page.locator('.field-stage[aria-busy=false]').waitFor({ state: 'attached', ...patience });
  }

  /** Presses the mouse at the first place and lets it go at the last. */
  async drag([first, ...others]) {
    await this.page.mouse.move(...first);
    await this.page.mouse.down();
    for (const place of others) await this.page.mouse.move(...place, { steps: 8 });
    await this.page.mouse.up();
  }

  threads() {
    return this.page.evaluate(() => window.tessera.threads);
  }
}
