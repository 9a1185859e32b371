// Keeps the page for visits without a network. What is large has been kept by the page itself (loading.js).
const build = {{build}};
const PREFIX = `ninja-game ${new URL(".", location.href).pathname} `;

self.addEventListener("install", (event) => {
  event.waitUntil(
    (async () => {
      const cache = await caches.open(PREFIX + build.id);
      await cache.addAll(["./", ...build.small].map((name) => new Request(name, { cache: "reload" })));
      for (const name of Object.keys(build.sizes)) {
        if (!(await cache.match(`${name}?v=${build.id}`))) await cache.add(`${name}?v=${build.id}`);
      }
      // A page that is open has loaded all that it needs; the next one is of this version.
      await self.skipWaiting();
    })(),
  );
});

self.addEventListener("activate", (event) => {
  event.waitUntil(
    (async () => {
      for (const name of await caches.keys()) {
        if (name.startsWith(PREFIX) && name !== PREFIX + build.id) await caches.delete(name);
      }
      await self.clients.claim();
    })(),
  );
});

self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || url.origin !== location.origin) return;
  event.respondWith(
    (async () => {
      const cache = await caches.open(PREFIX + build.id);
      const plain = url.href.split("#")[0];
      return (await cache.match(plain)) ?? (event.request.mode === "navigate" && isGame(url) ? await cache.match("./") : null) ?? fetch(event.request);
    })(),
  );
});

// The game's own page, whatever its query; other pages beside it (a board, a gallery) come from the host.
const isGame = (url) => ["./", "./index.html"].some((name) => url.origin + url.pathname === new URL(name, location.href).href);
