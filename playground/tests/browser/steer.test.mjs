// Steering a run with the mouse while it plays: everything is recorded, replays exactly, and is the same for the command.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { strFromU8, unzipSync } from "fflate";
import { site, tab, useBrowser, visit } from "./support.mjs";

useBrowser();

const { STARL } = process.env;

let folder;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), "starl-"));
});
after(async () => {
  rmSync(folder, { recursive: true });
});

const clock = async (page) => parseFloat(await page.locator(".clock").textContent());

async function digest(page) {
  await tab(page, /^Properties/);
  const shown = page.locator("dt", { hasText: "Digest" }).locator("+ dd");
  await page.waitForFunction((dd) => /^[0-9a-f]{16}$/.test(dd.textContent), await shown.elementHandle());
  return shown.textContent();
}

async function toTheEnd(page) {
  await page.getByLabel("Speed of playback").selectOption("Infinity");
  await page.locator(".play", { hasNotText: "Pause" }).click();
  await page.locator(".transport .outcome").waitFor();
}

/** The list of what was done. */
const done = (page) => page.getByRole("listbox", { name: "What was done to the run" }).getByRole("option");

async function drag(page, [fromX, fromY], [toX, toY]) {
  await page.mouse.move(fromX, fromY);
  await page.mouse.down();
  await page.mouse.move((fromX + toX) / 2, (fromY + toY) / 2, { steps: 3 });
  await page.mouse.move(toX, toY, { steps: 3 });
  await page.mouse.up();
}

test("a run is steered while it plays, and the saved scenario repeats it", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`, {
    acceptDownloads: true,
  });
  await page.locator(".play:enabled").waitFor();
  await page.getByLabel("Speed of playback").selectOption("0.25");
  await page.locator(".play").click();
  await tab(page, "Steer");
  // While the run plays, the panel is drawn again all the time.
  // Knobs stand where the scenario has them; a slider shows what holds in the run.
  for (const [name, before, value] of [
    ["Loss, %", "0", "30"],
    ["Delay, ms", "15", "80"],
  ]) {
    const [slider, field] = [page.getByLabel(name), page.getByLabel(name.replace(",", " as a number,"))];
    assert.equal(await field.inputValue(), before);
    assert.equal(await slider.inputValue(), before);
    await field.click();
    await page.keyboard.type(value, { delay: 120 });
    await page.keyboard.press("Enter");
    await page.waitForFunction(
      ([slider, value]) => slider.value === value,
      [await slider.elementHandle(), value],
    );
  }
  const robots = page.getByRole("tabpanel", { name: "Steer" }).getByRole("combobox", { name: /^Robots/ });
  await robots.selectOption({ label: "iRobot1" });
  await page.getByRole("button", { name: "Push", exact: true }).click();
  await page.getByRole("button", { name: "Cut these robots off" }).click();
  await page.getByRole("button", { name: "Crash", exact: true }).click();
  await page.getByRole("button", { name: "Restart", exact: true }).click();
  await page.getByRole("button", { name: "Heal" }).click();
  assert.ok((await clock(page)) < 13, "the run still plays");
  await toTheEnd(page);
  assert.equal(await done(page).count(), 7);
  const steered = await digest(page);

  // Going back and forth repeats it.
  await page.getByLabel("To the start").click();
  await toTheEnd(page);
  assert.equal(await digest(page), steered);

  await tab(page, "Steer");
  const saving = page.waitForEvent("download");
  await page.getByRole("button", { name: "With its programs" }).click();
  const download = await saving;
  assert.equal(download.suggestedFilename(), "race-steered.zip");
  const files = unzipSync(readFileSync(await download.path()));
  for (const [path, bytes] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, path)), { recursive: true });
    writeFileSync(join(folder, path), bytes);
  }
  assert.match(strFromU8(files["race-steered.toml"]), /kind = "push"/);

  // The page repeats the saved scenario.
  await tab(page, "Examples");
  await page.getByLabel("Files to open").setInputFiles({
    name: "race-steered (1).zip",
    mimeType: "application/zip",
    buffer: readFileSync(await download.path()),
  });
  await page.getByLabel("Name of the project").waitFor();
  await page.waitForFunction(() => document.querySelector(".clock")?.textContent.startsWith("0.00 s"));
  await toTheEnd(page);
  assert.equal(await digest(page), steered);
  assert.deepEqual(errors, []);
  await context.close();

  if (!STARL) return;
  const command = spawnSync(STARL, ["run", "race-steered.toml", "--json"], { cwd: folder, encoding: "utf8" });
  assert.equal(JSON.parse(command.stdout).digest, steered);
});

test("what is dragged in a run that stands still is seen at once, at a whole millimetre", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`);
  await page.locator(".play:enabled").waitFor();
  await page.getByRole("button", { name: "From above" }).click();
  await page.getByRole("button", { name: "Move" }).click();
  await page.waitForTimeout(600);
  const world = page.getByRole("application");
  const box = await world.boundingBox();
  // Looks for something to drag, as a person does: where the pointer changes.
  let from = null;
  for (let y = box.y + 100; y < box.y + box.height && !from; y += 14) {
    for (let x = box.x + 60; x < box.x + box.width && !from; x += 14) {
      await page.mouse.move(x, y);
      if ((await world.evaluate(({ style }) => style.cursor)) === "move") from = [x, y];
    }
  }
  assert.ok(from, "something can be dragged");
  await drag(page, from, [from[0] + 37, from[1] + 23]);
  await page.waitForFunction(() => parseFloat(document.querySelector(".clock").textContent) > 0);
  await tab(page, "Steer");
  const text = await done(page).first().textContent();
  assert.match(text, /^\s*0\.000 s(push|set waypoint|move obstacle)/);
  assert.doesNotMatch(text, /\d\.\d{4}/);
  assert.deepEqual(errors, []);
  await context.close();
});
