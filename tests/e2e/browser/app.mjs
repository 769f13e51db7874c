// The app as a user meets it: a page in Chromium, what it says and does, and what must never happen on it.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { launch } from './chromium.mjs';
import { serve } from './serve.mjs';

export const root = fileURLToPath(new URL('../../..', import.meta.url));
const site = `${root}/web/dist`;
const patience = { timeout: 120_000 };

/** Opens the app and hands it to `use`; afterwards there may be no complaint on its console and no request abroad. */
export async function withApp({ isolated, viewport = { width: 1440, height: 900 }, ...options }, use) {
  const host = await serve({ '/': site }, { isolated });
  const browser = await launch();
  const complaints = [];
  try {
    const context = await browser.newContext({ viewport, acceptDownloads: true, ...options });
    context.on('request', (request) => {
      if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(host.address))
        complaints.push(`a request to ${request.url()}`);
    });
    const page = await context.newPage();
    page.setDefaultTimeout(patience.timeout);
    page.on('console', (message) => {
      if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
    });
    page.on('pageerror', (error) => complaints.push(String(error)));
    await page.goto(host.address);
    await use(new App(page, host), page);
    assert.deepEqual(complaints, []);
  } finally {
    await browser.close();
    await host.stop();
  }
}

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

  /** The file behind a download link, as text. */
  async download(kind) {
    const [download] = await Promise.all([this.page.waitForEvent('download'), this.link(`Download ${kind}`).click()]);
    return { name: download.suggestedFilename(), text: await readFile(await download.path(), 'utf8') };
  }

  threads() {
    return this.page.evaluate(() => window.tessera.threads);
  }
}
