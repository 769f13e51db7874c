// Debian's Chromium without a screen, its graphics drawn in software.
import { chromium } from 'playwright-core';
import { serve } from './serve.mjs';

export const launch = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--headless=new',
      '--no-sandbox',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
    ],
  });

// One for all tests of a file: a browser takes seconds for its first page, whose shaders it compiles.
let browser;
export const closeBrowser = () => browser?.close();

/**
 * Hands `use` an empty page, and a host that serves `roots` ({'/prefix/': folder}) to it, isolated so that it may use
 * threads or not. `options` are those of a context of the browser's, which is the page's own.
 */
export async function withPage({ roots, isolated, ...options }, use) {
  const host = await serve(roots, { isolated });
  if (!browser?.isConnected()) browser = await launch();
  const context = await browser.newContext(options);
  try {
    return await use(await context.newPage(), host);
  } finally {
    await context.close();
    await host.stop();
  }
}
