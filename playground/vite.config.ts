import { defineConfig } from "vite";
import { offline } from "./build/offline.ts";
import { preloadModule } from "./build/preload.ts";

export default defineConfig({
  // Relative addresses: the page works in any folder of any static host.
  base: "./",
  build: {
    target: "es2022",
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
    // All code that every visit loads is in one file: each request costs headers, and small files compress badly.
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: [{ name: "page", tags: ["$initial"], includeDependenciesRecursively: false }],
        },
      },
    },
  },
  worker: { format: "es" },
  plugins: [preloadModule(), offline()],
  server: { host: "127.0.0.1", fs: { allow: [".."] } },
  test: { include: ["tests/unit/**/*.test.ts"] },
});
