// Makes the page one file, for notebooks: scripts, workers and styles stand in it, and {{RUN}}, {{TRACE}} and
// {{MODULE}} are the places of what it shows. Written by hand since all of it is about our own workers and module.

import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import type { Plugin } from "vite";

const WORKER = 'new Worker(new URL("./worker.ts", import.meta.url), { type: "module" })';

/** Puts workers into the bundle. */
export function inlineWorkers(): Plugin {
  return {
    name: "inline-workers",
    enforce: "pre",
    transform(code) {
      if (!code.includes(WORKER)) return null;
      const inlined = code.replace(WORKER, "new InlineWorker()");
      return `import InlineWorker from "./worker.ts?worker&inline";\n${inlined}`;
    },
  };
}

/** Takes the module from the file of the page. */
export function moduleFromFile(): Plugin {
  const embedded = fileURLToPath(new URL("../src/engine/module.embedded.ts", import.meta.url));
  return {
    name: "module-from-file",
    enforce: "pre",
    resolveId: (source) => (source.endsWith("/module.ts") ? embedded : null),
  };
}

/** The embedded page edits nothing: without the editor it is half as large. */
export function withoutBench(): Plugin {
  const NONE = "\0no-bench";
  return {
    name: "without-bench",
    enforce: "pre",
    resolveId: (source) => (source.endsWith("/Bench.tsx") ? NONE : null),
    load: (id) => (id === NONE ? "export const Bench = () => null;" : null),
  };
}

/** Writes the file instead of all others. */
export function oneFile(): Plugin {
  return {
    name: "one-file",
    generateBundle: {
      order: "post",
      handler(_options, bundle) {
        let script = "";
        let style = "";
        for (const [name, file] of Object.entries(bundle)) {
          delete bundle[name];
          if (file.type === "chunk") script += file.code;
          else if (name.endsWith(".css")) style += file.source;
        }
        const icon = readFileSync(new URL("../public/icon.svg", import.meta.url)).toString("base64");
        script = script.replaceAll("./icon.svg", `data:image/svg+xml;base64,${icon}`);
        this.emitFile({ type: "asset", fileName: "viewer.html", source: page(script, style) });
      },
    },
  };
}

function page(script: string, style: string): string {
  return `<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><title>StarL</title><style>${style}</style></head>
<body><div id="page"></div>
<script type="text/plain" id="starl-run">{{RUN}}</script>
<script type="text/plain" id="starl-trace">{{TRACE}}</script>
<script type="text/plain" id="starl-module">{{MODULE}}</script>
<script type="module">${script.replaceAll("</script", "<\\/script")}</script>
</body></html>
`;
}
