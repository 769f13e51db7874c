// Keeps the whole app for use without a network, and lets a plain static host's page use threads: answers carry the
// headers of cross-origin isolation, which such a host does not send. A page gets them from its second load on, when
// this worker is there to answer for it.

export {};

declare const __TESSERA_FILES__: { version: string; names: string[] };

const worker = globalThis as unknown as ServiceWorkerGlobalScope;
const files = __TESSERA_FILES__;
const kPrefix = 'tessera-';
const cacheName = `${kPrefix}${worker.registration.scope}${files.version}`;
const page = new URL('./', worker.registration.scope).href;

worker.addEventListener('install', (event) => {
  const addresses = files.names.map((name) => new Request(new URL(name, page), { cache: 'no-cache' }));
  event.waitUntil(caches.open(cacheName).then((cache) => cache.addAll(addresses)));
});

worker.addEventListener('activate', (event) => {
  event.waitUntil(
    (async () => {
      const ours = `${kPrefix}${worker.registration.scope}`;
      for (const name of await caches.keys()) {
        if (name.startsWith(ours) && name !== cacheName) await caches.delete(name);
      }
      await worker.clients.claim();
    })(),
  );
});

worker.addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method !== 'GET' || !request.url.startsWith(page)) return;
  event.respondWith(answer(request));
});

async function answer(request: Request): Promise<Response> {
  const cache = await caches.open(cacheName);
  const address = new URL(request.url);
  address.search = address.hash = '';
  if (address.href === page) address.pathname += 'index.html';
  const kept = await cache.match(address.href);
  return isolated(kept ?? (await fetch(request)));
}

function isolated(response: Response): Response {
  if (response.type === 'opaque' || response.type === 'error' || response.status === 304) return response;
  const headers = new Headers(response.headers);
  headers.set('Cross-Origin-Opener-Policy', 'same-origin');
  headers.set('Cross-Origin-Embedder-Policy', 'require-corp');
  const { status, statusText } = response;
  return new Response(response.body, { status, statusText, headers });
}
