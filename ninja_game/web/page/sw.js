// Keeps the site for visits without a network. What is large has been kept by the page itself (loading.js).
const kept = {{kept}};
const PREFIX = `ninja-game ${new URL(".", location.href).pathname} `;

self.addEventListener("install", (event) => {
  event.waitUntil(
    (async () => {
      const cache = await caches.open(PREFIX + kept.id);
      const newest = (name) => new Request(name, { cache: "reload" });
      await cache.addAll(kept.small.map(newest));
      for (const name of kept.large) if (!(await cache.match(name))) await cache.add(name);
      // Pages that are not on this host are none of the game's needs.
      await Promise.allSettled(kept.pages.map((name) => cache.add(newest(name))));
      // A page that is open has loaded all that it needs; the next one is of this version.
      await self.skipWaiting();
    })(),
  );
});

self.addEventListener("activate", (event) => {
  event.waitUntil(
    (async () => {
      for (const name of await caches.keys()) {
        if (name.startsWith(PREFIX) && name !== PREFIX + kept.id) await caches.delete(name);
      }
      await self.clients.claim();
    })(),
  );
});

const OF_THE_GAME = new Set(kept.small.concat(kept.large).map((name) => new URL(name, location.href).href));

self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || url.origin !== location.origin) return;
  event.respondWith(answer(event.request, url.origin + url.pathname));
});

// The game comes from the cache; everything beside it (gallery, board, documents) from the host, or as it was last seen.
async function answer(request, plain) {
  const cache = await caches.open(PREFIX + kept.id);
  if (OF_THE_GAME.has(plain)) return (await cache.match(plain)) ?? fetch(request);
  try {
    const response = await fetch(request);
    if (response.status === 200) cache.put(plain, response.clone()).catch(() => {}); // no room: not kept
    return response;
  } catch (error) {
    const seen = await cache.match(plain.endsWith("/") ? `${plain}index.html` : plain);
    if (seen) return seen;
    if (request.mode !== "navigate") throw error;
    const text = "<!doctype html><title>No network</title><h1>No network</h1><p>This page was not visited before.";
    return new Response(text, { status: 503, headers: { "Content-Type": "text/html" } });
  }
}
