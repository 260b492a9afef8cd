// Measures the main thread's work for a picture of 1,000 robots with paths: node tests/frames.mjs [ROBOTS], after
// `make page`. Counts the processor time of all tasks of the main thread in a trace of the browser, from one picture to
// the next. WebGL's draw calls do nothing: the software rasteriser that carries them out in another process would leave
// no time for 60 pictures a second, and its work does not count. All that prepares them is done.

import { browser, revisit, site, start, stop } from "./browser/support.mjs";

const ROBOTS = Number(process.argv[2] ?? 1000);
const SECONDS = 8;
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

function drawNothing() {
  for (const name of ["Arrays", "Elements", "ArraysInstanced", "ElementsInstanced"])
    WebGL2RenderingContext.prototype[`draw${name}`] = () => {};
}

await start();
const project = { name: "Frames", files, scenario: "hello.toml" };
const options = { viewport: { width: 1440, height: 900 }, script: drawNothing };
const { page, errors } = await revisit(site.url, project, options);
await page.locator(".play:enabled").waitFor({ timeout: 60_000 });
await page.locator(".play").click();
await page.waitForTimeout(5000);
await browser.startTracing(page, { categories: ["toplevel", "blink"] });
await page.waitForTimeout(SECONDS * 1000);
const { traceEvents } = JSON.parse((await browser.stopTracing()).toString());
const clock = await page.locator(".clock").textContent();
await stop();

const main = traceEvents.find(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain");
const on = traceEvents
  .filter(({ pid, tid }) => pid === main.pid && tid === main.tid)
  .sort((one, other) => one.ts - other.ts);
const pictures = on.filter(({ name }) => name === "WebFrameWidgetImpl::BeginMainFrame").map(({ ts }) => ts);
/** Processor time of the tasks from each picture to the next, ms. */
const work = pictures.slice(1).map(() => 0);
let at = -1;
for (const { name, ts, tdur = 0 } of on) {
  while (at + 1 < pictures.length && pictures[at + 1] <= ts) at++;
  // The task of a picture begins before its callback.
  if (name.endsWith("RunTask") && at >= 0 && at < work.length) work[at] += tdur / 1000;
}
work.sort((one, other) => one - other);
const share = (part) => work[Math.floor(part * (work.length - 1))]?.toFixed(2);
const mean = work.reduce((sum, each) => sum + each, 0) / work.length;
console.log(`${ROBOTS} robots, at ${clock}: ${pictures.length} pictures in ${SECONDS} s`);
console.log(
  `main thread, ms of processor time a picture: mean ${mean.toFixed(2)}, median ${share(0.5)}, 95 % ${share(0.95)}`,
);
if (errors.length > 0) console.log(errors);
