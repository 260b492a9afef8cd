// Measures what a first visit loads and how long it waits: node tests/speed.mjs, after `make page`.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { DIST, launch, serve, visit } from "./browser/support.mjs";

const RUNS = 5;
const site = await serve();
const browser = await launch();
const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];

/** Opens a page in a new context, without a cache; gives the files that it loads, and the ms until `ready`. */
async function cold(address, ready) {
  const loaded = new Set();
  const began = performance.now();
  const { page, context } = await visit(browser, "about:blank");
  page.on("request", (request) => loaded.add(new URL(request.url()).pathname));
  const opened = performance.now();
  await page.goto(site.url + address);
  await ready(page);
  const took = performance.now() - opened;
  await page.waitForTimeout(1500);
  await context.close();
  return { loaded, took, began };
}

const examples = (page) => page.locator(".card").first().waitFor();
const moving = (page) =>
  page.waitForFunction(() => parseFloat(document.querySelector(".clock")?.textContent) > 0);
const runs = [];
for (let run = 0; run < RUNS; run++) runs.push(await cold("", examples));
let [brotli, gzip] = [0, 0];
for (const path of runs[0].loaded) {
  // The service worker fetches the rest of the page for later, when this is done.
  if (path === "/sw.js" || path.endsWith(".svg")) continue;
  const content = readFileSync(join(DIST, path === "/" ? "index.html" : path));
  brotli += brotliCompressSync(content).length;
  gzip += gzipSync(content).length;
}
console.log(
  `first visit, pictures left out: ${(brotli / 1e6).toFixed(2)} MB by Brotli, ${(gzip / 1e6).toFixed(2)} MB by gzip`,
);
console.log(
  `examples are there after ${median(runs.map(({ took }) => took)).toFixed(0)} ms (median of ${RUNS})`,
);
const played = [];
for (let run = 0; run < RUNS; run++) {
  played.push(
    await cold("?example=race", async (page) => {
      await page.locator(".play:enabled").click();
      await moving(page);
    }),
  );
}
console.log(`Race moves after ${median(played.map(({ took }) => took)).toFixed(0)} ms (median of ${RUNS})`);
await browser.close();
await site.close();
