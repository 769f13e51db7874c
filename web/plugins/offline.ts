import { createHash } from 'node:crypto';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import type { Plugin } from 'vite';

const kPlaceholder = '__TESSERA_FILES__';

// Notes and the vector originals of the samples are not part of the page.
const isPageFile = (name: string) => !name.endsWith('.md') && !/^samples\/.*\.svg$/.test(name);

/** Tells the service worker which files make up this build, and a name for the whole of them. */
export function offline(publicFolder: string): Plugin {
  return {
    name: 'tessera-offline',
    enforce: 'post',
    generateBundle: {
      order: 'post',
      handler(_options, bundle) {
        const worker = bundle['sw.js'];
        if (worker?.type !== 'chunk') return;
        const hash = createHash('sha256');
        const names: string[] = [];
        const add = (name: string, content: string | Uint8Array) => {
          names.push(name);
          hash.update(name).update(content);
        };
        for (const [name, file] of Object.entries(bundle).sort(([a], [b]) => (a < b ? -1 : 1))) {
          if (file !== worker) add(name, file.type === 'chunk' ? file.code : file.source);
        }
        for (const name of filesBelow(publicFolder).filter(isPageFile)) {
          add(name, readFileSync(join(publicFolder, name)));
        }
        const files = JSON.stringify({ version: hash.digest('hex').slice(0, 16), names });
        worker.code = worker.code.replaceAll(kPlaceholder, () => files);
      },
    },
  };
}

function filesBelow(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true, recursive: true })
    .filter((entry) => entry.isFile())
    .map((entry) =>
      join(entry.parentPath, entry.name)
        .slice(folder.length + 1)
        .replaceAll('\\', '/'),
    )
    .sort();
}
