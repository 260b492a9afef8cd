// Measures a first visit, after `make page`: node tests/speed.mjs. Prints the bytes on the wire and the time until
// examples can be chosen and until Race moves, from a host that compresses by Brotli and from one that compresses by
// gzip. Chromium counts the bytes, headers included. With --files, all files are listed.

import { site, start, stop, visit } from "./browser/support.mjs";

const RUNS = 5;
const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];

/** Opens a page in a new context, without a cache; gives the bytes on the wire and the ms until `ready`. */
async function cold(address, ready) {
  const { page, context } = await visit("about:blank");
  const session = await context.newCDPSession(page);
  await session.send("Network.enable");
  let bytes = 0;
  session.on("Network.loadingFinished", ({ encodedDataLength }) => {
    bytes += encodedDataLength;
  });
  const opened = performance.now();
  await page.goto(site.url + address);
  await ready(page);
  const took = performance.now() - opened;
  // The visit includes files that load after that.
  await page.waitForLoadState("networkidle");
  const until = bytes;
  const marks = await page.evaluate(() =>
    performance.getEntriesByType("resource").map(({ name, startTime, responseEnd, encodedBodySize }) => ({
      name: name.replace(/.*\//, ""),
      from: Math.round(startTime),
      to: Math.round(responseEnd),
      bytes: encodedBodySize,
    })),
  );
  await context.close();
  return { took, bytes: until, marks };
}

const examples = (page) => page.locator(".card").first().waitFor();
const moves = (page) =>
  page.waitForFunction(() => parseFloat(document.querySelector(".clock")?.textContent) > 0);

const visits = {
  "examples can be chosen": ["", examples],
  "Race moves": [
    "?example=race",
    async (page) => {
      await page.locator(".play:enabled").click();
      await moves(page);
    },
  ],
};

for (const coding of ["br", "gzip"]) {
  await start({ coding });
  for (const [what, [address, ready]] of Object.entries(visits)) {
    const runs = [];
    for (let run = 0; run < RUNS; run++) runs.push(await cold(address, ready));
    const size = (median(runs.map(({ bytes }) => bytes)) / 1e6).toFixed(3);
    const took = median(runs.map(({ took }) => took)).toFixed(0);
    console.log(`${coding}: ${what} after ${size} MB and ${took} ms (medians of ${RUNS})`);
    if (process.argv.includes("--files")) console.table(runs[0].marks);
  }
  await stop();
}
