import { createReadStream, existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import type { Plugin } from 'vite';

const kFolder = 'engine/';
const isEngineFile = (name: string) => /^tessera-.*\.(js|mjs|wasm)$/.test(name);

/**
 * Puts Emscripten's files into the site as they are, as engine/NAME: they find each other by address, and a bundler
 * would rename them.
 */
export function engineFiles(dist: string): Plugin {
  return {
    name: 'tessera-engine-files',
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const name = new URL(request.url ?? '/', 'http://localhost').pathname.slice(1 + kFolder.length);
        const file = join(dist, name);
        if (!request.url?.startsWith(`/${kFolder}`) || !isEngineFile(name) || !existsSync(file)) return next();
        response.setHeader('Content-Type', name.endsWith('.wasm') ? 'application/wasm' : 'text/javascript');
        for (const [header, value] of Object.entries(server.config.server.headers ?? {})) {
          response.setHeader(header, String(value));
        }
        createReadStream(file).pipe(response);
      });
    },
    generateBundle() {
      const names = existsSync(dist) ? readdirSync(dist).filter(isEngineFile) : [];
      if (names.length === 0) this.error(`no engine in ${dist}; build the package tessera-wasm first`);
      for (const name of names) {
        this.emitFile({ type: 'asset', fileName: kFolder + name, source: readFileSync(join(dist, name)) });
      }
    },
  };
}
