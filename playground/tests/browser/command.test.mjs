// The page as the command serves it: a run that the command simulates, and a trace. STARL names the command.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, truncateSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after, before, test } from "node:test";
import { DIST, useBrowser, visit } from "./support.mjs";

useBrowser();

const { STARL } = process.env;
const skip = STARL ? false : "STARL names no command";
const RUN = ["run", "race", "--seed", "7", "--set", "network.loss=0.1"];

let folder;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), "starl-"));
});
const children = [];
after(async () => {
  for (const child of children) child.kill();
  rmSync(folder, { recursive: true });
});

/** Starts a command that serves the page; gives its address. */
async function served(...command) {
  const child = spawn(STARL, [...command, "--no-browser", "--page", DIST]);
  children.push(child);
  const lines = createInterface({ input: child.stdout });
  const address = await new Promise((resolve, reject) => {
    lines.on("line", (line) => line.includes("http://") && resolve(line.match(/http:\S+/)[0]));
    child.on("exit", (status) => reject(new Error(`${command.join(" ")} ended with ${status}`)));
  });
  return address;
}

async function playToTheEnd(page) {
  await page.locator(".play:enabled").waitFor();
  await page.getByLabel("Speed of playback").selectOption("Infinity");
  await page.locator(".play").click();
  await page.locator(".transport .outcome.reached").waitFor();
}

async function digest(page) {
  await page.getByRole("tab", { name: "Properties" }).click();
  const shown = page.locator("dt", { hasText: "Digest" }).locator("+ dd");
  await page.waitForFunction((dd) => /^[0-9a-f]{16}$/.test(dd.textContent), await shown.elementHandle());
  return shown.textContent();
}

const report = (...options) =>
  JSON.parse(spawnSync(STARL, [...RUN, "--json", ...options], { encoding: "utf8" }).stdout);

test("a run of the command plays in the page with its digest, and a robot crashes in it", {
  skip,
}, async () => {
  const address = await served(...RUN, "--open");
  const { page, context, errors } = await visit(address);
  await playToTheEnd(page);
  assert.equal(await digest(page), report().digest);
  await page.getByLabel("To the start").click();
  await page.getByRole("tab", { name: "Robots" }).click();
  await page.getByRole("option").first().click();
  await page.getByRole("button", { name: "Crash" }).first().click();
  await page.getByLabel("To the next event").click();
  await page.getByRole("option").first().getByText("down").waitFor();
  assert.deepEqual(errors, []);
  await context.close();
});

test("a trace is shown as far as it goes, and can be run again with the same digest", { skip }, async () => {
  const trace = join(folder, "race.mcap");
  const { digest: recorded } = report("--trace", trace);
  const address = await served("view", trace);
  const { page, context, errors } = await visit(address);
  await playToTheEnd(page);
  assert.equal(await digest(page), recorded);
  await page.getByRole("tab", { name: "Robots" }).click();
  await page.getByRole("option").first().click();
  await page.getByRole("button", { name: "Run it again here" }).click();
  await page.waitForFunction(() => document.querySelector("h1")?.textContent.endsWith("run again"));
  await playToTheEnd(page);
  assert.equal(await digest(page), recorded);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a trace whose end is missing is shown up to there", { skip }, async () => {
  const trace = join(folder, "cut.mcap");
  // Long enough for several chunks; of a chunk that is not whole nothing can be read.
  spawnSync(STARL, ["run", "search", "--quiet", "--trace", trace]);
  truncateSync(trace, Math.floor(statSync(trace).size * 0.6));
  const address = await served("view", trace);
  const { page, context, errors } = await visit(address);
  await page.locator(".play:enabled").waitFor();
  await page.getByLabel("To the furthest known moment").click();
  await page.waitForFunction(() => parseFloat(document.querySelector(".clock").textContent) > 1);
  assert.deepEqual(errors, []);
  await context.close();
});

const FLEET = `
program = "race.starl"
duration = "60s"
[world]
way_point = [{ name = "A", position = [3, 0] }, { name = "B", position = [3, 3] }]
[[robots]]
model = "holonomic"
name = "robot"
count = 2
start = [{ position = [0, 0] }, { position = [0, 1] }]
`;

test("a fleet that runs is followed as it happens", { skip }, async () => {
  writeFileSync(join(folder, "race.toml"), FLEET);
  const program = new URL("../../../examples/race/race.starl", import.meta.url);
  writeFileSync(join(folder, "race.starl"), readFileSync(program));
  const port = 20_000 + (process.pid % 20_000);
  writeFileSync(join(folder, "fleet.toml"), `scenario = "race.toml"\n[link]\nfirst_port = ${port}\n`);
  assert.equal(spawnSync(STARL, ["fleet", "key", "fleet.toml"], { cwd: folder }).status, 0);
  const address = await served("view", join(folder, "fleet.toml"));
  const { page, context, errors } = await visit(address);
  // Before the fleet starts its robots stand where they will start.
  await page.locator(".play:enabled").waitFor();
  children.push(spawn(STARL, ["fleet", "up", "fleet.toml"], { cwd: folder }));
  await page.getByRole("tab", { name: "Robots" }).click();
  await page.getByRole("option").first().getByText("wait").waitFor({ timeout: 30_000 });
  const before = parseFloat(await page.locator(".clock").textContent());
  const follows = (then) => parseFloat(document.querySelector(".clock").textContent) > then + 1;
  await page.waitForFunction(follows, before);
  await page.getByRole("tab", { name: "Log" }).click();
  await page.getByText("robot0: finished").waitFor({ timeout: 30_000 });
  assert.equal(await page.getByText("has not answered").count(), 0);
  if (process.env.PICTURE) await page.screenshot({ path: process.env.PICTURE });
  await page.getByLabel("To the start").click();
  await page.waitForFunction(() => parseFloat(document.querySelector(".clock").textContent) === 0);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a file that is no trace is refused before anything is served", { skip }, () => {
  const file = join(folder, "no.mcap");
  writeFileSync(file, readFileSync(new URL(import.meta.url)));
  const { status, stderr } = spawnSync(STARL, ["view", file, "--no-browser", "--page", DIST], {
    encoding: "utf8",
  });
  assert.equal(status, 2);
  assert.match(stderr, /no\.mcap/);
});
