// Has browsers load the WebAssembly module with the page itself, before any script runs: it is the largest part.

import type { Plugin } from "vite";

export function preloadModule(): Plugin {
  return {
    name: "preload-module",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler(_html, { bundle }) {
        const module = Object.keys(bundle ?? {}).find((name) => name.endsWith(".wasm"));
        if (!module) throw new Error("the page has no WebAssembly module");
        const attrs = {
          rel: "preload",
          as: "fetch",
          type: "application/wasm",
          crossorigin: true,
          href: `./${module}`,
        };
        return [{ tag: "link", attrs, injectTo: "head" }];
      },
    },
  };
}
