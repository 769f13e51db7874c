// Makes the pictures of the pebbles' presets in public/presets: what the built app shows of each, in Chromium.
//
// usage: node scripts/shoot_presets.mjs     (after npm run build)
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { closeBrowser, withApp } from '../tests/e2e/browser/app.mjs';
import { root } from '../tests/e2e/root.mjs';

const WIDTH = 152;
const HEIGHT = 114;
const TIMES = 3; // drawn larger, then reduced
const STEPS_NEARER = 5;

const { pebbles } = JSON.parse(readFileSync(join(root, 'web/src/techniques/presets.json'), 'utf8'));

/** The middle of a screenshot, reduced to a preset's size. */
const reduced = (page, screenshot) =>
  page.evaluate(
    async ([bytes, width, height, times]) => {
      const blob = new Blob([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))]);
      const bitmap = await createImageBitmap(blob);
      const canvas = new OffscreenCanvas(width, height);
      const context = canvas.getContext('2d', { alpha: false });
      context.imageSmoothingQuality = 'high';
      const [w, h] = [width * times, height * times];
      context.drawImage(bitmap, (bitmap.width - w) / 2, (bitmap.height - h) / 2, w, h, 0, 0, width, height);
      const png = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
      return btoa(String.fromCharCode(...png));
    },
    [screenshot.toString('base64'), WIDTH, HEIGHT, TIMES],
  );

const viewport = { width: 1500, height: 900 };
await withApp({ isolated: true, hash: '#technique=pebbles', viewport, reducedMotion: 'reduce' }, async (app, page) => {
  await app.finished();
  const canvas = page.locator('.field-canvas canvas');
  for (const { title, picture } of pebbles) {
    await app.button(title).click();
    await app.running();
    await app.finished();
    await app.fieldShown();
    await app.button('Fit the field').click();
    for (let i = 0; i < STEPS_NEARER; ++i) await app.button('Nearer').click();
    const bare = await page.evaluateHandle(() => [...document.querySelectorAll('.field-stage .tool-group')]);
    await bare.evaluate((all) => all.forEach((group) => (group.style.visibility = 'hidden')));
    const screenshot = await canvas.screenshot();
    await bare.evaluate((all) => all.forEach((group) => (group.style.visibility = '')));
    writeFileSync(join(root, 'public', picture), Buffer.from(await reduced(page, screenshot), 'base64'));
  }
});
await closeBrowser();
