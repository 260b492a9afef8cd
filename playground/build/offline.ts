// Adds a service worker to the build, so that the page works without a network once it has been loaded.

import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "vite";

export function offline(): Plugin {
  let publicDir = "";
  return {
    name: "offline",
    apply: "build",
    configResolved(config) {
      publicDir = config.publicDir;
    },
    generateBundle: {
      order: "post",
      handler(_options, bundle) {
        const files = Object.keys(bundle).filter((name) => !name.endsWith(".map"));
        const copied = readdirSync(publicDir);
        // The names in assets/ contain a hash of their content; others do not, so their contents count too.
        const version = createHash("sha256");
        for (const name of files.sort()) {
          const file = bundle[name];
          version.update(name);
          if (file?.type === "asset") version.update(file.source);
        }
        for (const name of copied.sort()) version.update(name).update(readFileSync(join(publicDir, name)));
        const cache = `starl-${version.digest("hex").slice(0, 16)}`;
        const all = ["./", ...files, ...copied];
        this.emitFile({ type: "asset", fileName: "sw.js", source: serviceWorker(cache, all) });
      },
    },
  };
}

function serviceWorker(cache: string, files: string[]): string {
  return `// Answers from the files that came with the page; asks the network only for what is not among them.
const CACHE = ${JSON.stringify(cache)};
const FILES = ${JSON.stringify(files)};
self.addEventListener("install", (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(FILES)).then(() => self.skipWaiting()));
});
self.addEventListener("activate", (event) => {
  const remove = (names) => Promise.all(names.filter((name) => name !== CACHE).map((name) => caches.delete(name)));
  event.waitUntil(caches.keys().then(remove).then(() => self.clients.claim()));
});
self.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET") return;
  event.respondWith(caches.match(event.request, { ignoreSearch: true }).then((found) => found ?? fetch(event.request)));
});
`;
}
