// Measures the main thread's work for a picture of 1,000 robots with paths: node tests/frames.mjs [ROBOTS], after
// `make page`. Counts the processor time of the main thread in a trace of the browser: the process that rasterises
// without a graphics card does not count. That process limits the pictures in a second, so the work between pictures,
// which does not depend on their number, is counted by time.

import { launch, revisit, serve } from "./browser/support.mjs";

const ROBOTS = Number(process.argv[2] ?? 1000);
const SECONDS = 8;
/** Pictures in a second on a machine with a graphics card. Without one there are fewer. */
const RATE = 60;
const side = Math.ceil(Math.sqrt(ROBOTS));
const files = {
  "hello.starl": `/// Robots visit places near them, one after the other.
program Hello

motion = ReachAvoid()

go()
    pre not motion.active
    eff motion.reach_avoid(position + Point(random(-2.0, 2.0), random(-2.0, 2.0)), obstacles())
`,
  "hello.toml": `program = "hello.starl"
duration = "600s"
[[robots]]
model = "create"
count = ${ROBOTS}
area = { low = [0, 0], high = [${side}, ${side}] }
`,
};

const site = await serve();
const browser = await launch();
const project = { name: "Frames", files, scenario: "hello.toml" };
const { page, errors } = await revisit(browser, site.url, project, {
  viewport: { width: 1440, height: 900 },
});
await page.locator(".play:enabled").waitFor({ timeout: 60_000 });
await page.locator(".play").click();
await page.waitForTimeout(5000);
await browser.startTracing(page, {
  categories: ["toplevel", "devtools.timeline", "disabled-by-default-devtools.timeline"],
});
await page.waitForTimeout(SECONDS * 1000);
const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
const clock = await page.locator(".clock").textContent();
await browser.close();
await site.close();

const main = traceEvents.find(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain");
const on = traceEvents.filter(({ pid, tid }) => pid === main.pid && tid === main.tid);
const pictures = on.filter(({ name }) => name === "FireAnimationFrame").length;
const spent = (...names) =>
  on.filter(({ name }) => names.includes(name)).reduce((all, { tdur = 0 }) => all + tdur / 1000, 0);
const painting = spent(
  "FireAnimationFrame",
  "UpdateLayoutTree",
  "Layout",
  "PrePaint",
  "Paint",
  "Layerize",
  "Commit",
);
const others = spent("RunTask") - painting;
const [picture, rest] = [painting / pictures, others / SECONDS / RATE];
console.log(`${ROBOTS} robots, at ${clock}: ${pictures} pictures in ${SECONDS} s`);
console.log(
  `${picture.toFixed(2)} ms of processor time draw a picture; all else takes ${rest.toFixed(2)} ms in 1/${RATE} s`,
);
console.log(`${(picture + rest).toFixed(2)} ms of the main thread for each of ${RATE} pictures in a second`);
if (errors.length > 0) console.log(errors);
