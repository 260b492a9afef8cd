import { defineConfig } from "vite";
import { inlineWorkers, moduleFromFile, oneFile, withoutBench } from "./build/embedded.ts";

// The page as one file, for notebooks: build/embedded.ts.
export default defineConfig({
  base: "./",
  publicDir: false,
  build: {
    target: "es2022",
    outDir: "embedded",
    modulePreload: false,
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    cssCodeSplit: false,
    chunkSizeWarningLimit: 4000,
    rolldownOptions: { input: "src/embedded.tsx", output: { codeSplitting: false } },
  },
  // Browsers start no workers of modules from a file on disk.
  worker: {
    format: "iife",
    rolldownOptions: { output: { codeSplitting: false } },
  },
  plugins: [inlineWorkers(), moduleFromFile(), withoutBench(), oneFile()],
});
