import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';
import { engineFiles } from './plugins/engine-files.ts';
import { offline } from './plugins/offline.ts';
import { policyOnlyInBuilds } from './plugins/policy.ts';

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

const { version } = JSON.parse(readFileSync(here('../package.json'), 'utf8')) as { version: string };

// What a page needs before it may share memory between threads. A plain static host sends neither; TESSERA_PLAIN_HOST=1
// makes the servers here behave like one.
const headers: Record<string, string> =
  process.env.TESSERA_PLAIN_HOST === '1'
    ? {}
    : { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

export default defineConfig({
  root: here('.'),
  base: './',
  publicDir: here('../public'),
  define: { __TESSERA_VERSION__: JSON.stringify(version) },
  plugins: [engineFiles(here('./package/dist/engine')), offline(here('../public')), policyOnlyInBuilds()],
  server: { headers },
  preview: { headers },
  worker: { format: 'es' },
  build: {
    outDir: here('./dist'),
    emptyOutDir: true,
    target: 'es2022',
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 700, // three.js, which only one tab loads
    rolldownOptions: {
      input: { app: here('./index.html'), sw: here('./sw/sw.ts') },
      output: { entryFileNames: (chunk) => (chunk.name === 'sw' ? 'sw.js' : 'assets/[name]-[hash].js') },
    },
  },
  test: { include: ['src/**/*.test.ts'] },
});
