// Takes the pictures of the README again, in a headless Chromium:
//
//     npm run screenshots              after `make page`
//     python3 build/animate.py         makes docs/pictures/race.gif of the frames; needs Pillow
//
// Run it again when the look of the page has changed.

import { mkdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { site, start, stop, visit } from "../tests/browser/support.mjs";

const OUT = fileURLToPath(new URL("../../docs/pictures/", import.meta.url));
const FRAMES = join(tmpdir(), "starl-frames");
const FRAME_COUNT = 40;
/** Of the world in the animation, px. */
const WORLD = { width: 520, height: 455 };
const WINDOW = { width: 1440, height: 880 };
/** Of the run of Race, s. */
const FRAME_EVERY = 0.34;

/** Opens an example, and runs it to its end, so that every moment is known. */
async function open(example, options) {
  const visited = await visit(`${site.url}?example=${example}`, options);
  const { page } = visited;
  await page.locator(".play:enabled").waitFor();
  await page.getByLabel("Speed of playback").selectOption("Infinity");
  await page.locator(".play").click();
  await page.locator(".transport .outcome.reached").waitFor({ timeout: 120_000 });
  await page.getByLabel("Speed of playback").selectOption("1");
  await page.getByLabel("To the start").click();
  await page.locator(".clock", { hasText: /^0\.00 s/ }).waitFor();
  return visited;
}

/** Goes to a moment, s, with the arrow key of the timeline. */
async function goTo(page, moment) {
  const clock = () => page.locator(".clock").textContent();
  await page.getByRole("slider", { name: "Moment of the run" }).focus();
  for (let shown = await clock(); parseFloat(shown) < moment; shown = await clock()) {
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction((shown) => document.querySelector(".clock").textContent !== shown, shown);
  }
  await page.evaluate(() => document.activeElement?.blur());
  // The view follows what moves.
  await page.waitForTimeout(600);
}

await start();
mkdirSync(OUT, { recursive: true });

const race = await open("race", { viewport: WINDOW });
await goTo(race.page, 8.6);
await race.page.getByRole("listbox", { name: "Robots" }).getByRole("option").nth(2).click();
await race.page.waitForTimeout(1000);
await race.page.screenshot({ path: `${OUT}race.png` });
await race.context.close();

const search = await open("search", { viewport: WINDOW, colorScheme: "dark" });
await search.page.getByRole("tab", { name: "Messages" }).click();
await goTo(search.page, 76);
await search.page.screenshot({ path: `${OUT}search.png` });
await search.context.close();

rmSync(FRAMES, { recursive: true, force: true });
mkdirSync(FRAMES);
// The world alone, in a window in which it has the size of the animation.
const moving = await open("race", { viewport: { width: 1290, height: 650 } });
const world = moving.page.getByRole("application");
for (let frame = 0; frame < FRAME_COUNT; frame++) {
  await goTo(moving.page, frame * FRAME_EVERY);
  const { x, y, width, height } = await world.boundingBox();
  const clip = { x: x + (width - WORLD.width) / 2, y: y + (height - WORLD.height) / 2, ...WORLD };
  await moving.page.screenshot({ path: `${FRAMES}/${String(frame).padStart(2, "0")}.png`, clip });
}
await moving.context.close();
await stop();
