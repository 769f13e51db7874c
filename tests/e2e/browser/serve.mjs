// A plain static host for tests, with or without the headers that let a page use threads.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const types = {
  '.css': 'text/css',
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.json': 'application/json',
  '.mjs': 'text/javascript',
  '.png': 'image/png',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
  '.webmanifest': 'application/manifest+json',
};
const isolating = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

/** The file of a request below one of `roots` ({'/prefix/': folder}); null where there is none. */
function fileOf(url, roots) {
  const path = normalize(decodeURIComponent(new URL(url, 'http://host').pathname));
  for (const [prefix, folder] of Object.entries(roots)) {
    if (!path.startsWith(prefix)) continue;
    const file = join(folder, path.slice(prefix.length) || 'index.html');
    if (statSync(file, { throwIfNoEntry: false })?.isFile()) return file;
  }
  return null;
}

/** Serves folders on a free port of this machine. `stop()` ends it, as pulling the plug would. */
export async function serve(roots, { isolated }) {
  const requests = [];
  const server = createServer((request, response) => {
    requests.push(request.url);
    const file = fileOf(request.url, roots);
    response.writeHead(file ? 200 : 404, {
      'Content-Type': types[extname(file ?? '')] ?? 'application/octet-stream',
      'Cache-Control': 'no-cache',
      ...(isolated ? isolating : {}),
    });
    if (file) createReadStream(file).pipe(response);
    else response.end();
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return {
    address: `http://127.0.0.1:${server.address().port}`,
    requests,
    stop: () => {
      server.closeAllConnections();
      return new Promise((done) => server.close(done));
    },
  };
}
