// A sweep finds a program's fault, shrinks the failure and shows it.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { revisit, site, useBrowser } from "./support.mjs";

useBrowser();

const TESTS = new URL("../../../apps/starl-wasm/tests/it/", import.meta.url);
/** Robots that rely on hearing numbers in order, which the network does not promise. */
const FILES = {
  "programs/ordered.starl": readFileSync(new URL("ordered.starl", TESTS), "utf8"),
  "worlds/ordered.toml": readFileSync(new URL("ordered.toml", TESTS), "utf8"),
};

/** Opens the page with the project of an earlier visit, at its sweep. */
async function open(files, scenario) {
  const project = { name: "Ordered", files, scenario };
  const visited = await revisit(site.url, project, { viewport: { width: 1060, height: 700 } });
  const { page, errors } = visited;
  page.setDefaultTimeout(20_000);
  await page.getByRole("tab", { name: "Sweep" }).click();
  await page.getByRole("checkbox", { name: /calm/ }).waitFor();
  // A static host has no start.json, which the browser reports.
  const faults = () => errors.filter((error) => !error.includes("status of 404"));
  return { ...visited, faults };
}

async function choose(page, ...profiles) {
  for (const box of await page.getByRole("group", { name: "Profiles of faults" }).getByRole("checkbox").all())
    await box.uncheck();
  for (const name of profiles) await page.getByRole("checkbox", { name: new RegExp(`^${name}`) }).check();
}

const cells = async (page, profile) =>
  (await page
    .locator(".outcomes tr", { has: page.getByRole("rowheader", { name: profile }) })
    .textContent()) ?? "";

test("a failure that a sweep finds is shrunk and shown at its violation", async () => {
  const { page, context, faults } = await open(FILES, "worlds/ordered.toml");
  await choose(page, "calm", "lossy");
  await page.getByLabel("Seeds").fill("6");
  await page.getByRole("button", { name: "Start the sweep" }).click();
  await page.getByText(/^12 of 12 runs, /).waitFor();
  assert.equal(await cells(page, "calm"), "calm66000");
  assert.match(await cells(page, "lossy"), /^lossy600[1-6]0$/);

  const failures = page.getByRole("listbox", { name: "Runs that went wrong" }).getByRole("option");
  assert.match(await failures.first().textContent(), /lossy, seed 1: Ordered\.in_order violated/);
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save as CSV" }).click(),
  ]);
  const table = readFileSync(await download.path(), "utf8")
    .trimEnd()
    .split("\r\n");
  assert.equal(table.length, 13);
  assert.match(table[0], /^profile,seed,outcome,wrong/);

  await page.getByRole("button", { name: "Shrink and open" }).click();
  await page.getByText(/Shrunk from 4 robots.* to 2 robots/).waitFor();
  assert.match(await page.locator("h1").textContent(), /Ordered\.in_order/);
  await page.getByRole("heading", { name: "Possible causes" }).waitFor();
  await page.getByText("Ordered.in_order violated").first().waitFor();
  await page.getByRole("button", { name: "Add worlds/lossy-1-small.toml to the project" }).click();
  await page.getByRole("tab", { name: "Program", exact: true }).click();
  await page.getByText("lossy-1-small.toml").first().waitFor();
  assert.deepEqual(faults(), []);
  await context.close();
});

test("a run of a sweep opens as it is, and a sweep that is stopped keeps what it found", async () => {
  const { page, context, faults } = await open(FILES, "worlds/ordered.toml");
  await choose(page, "lossy");
  await page.getByLabel("Seeds").fill("10000");
  await page.getByRole("button", { name: "Start the sweep" }).click();
  await page.getByRole("option", { name: /lossy, seed 1:/ }).click();
  await page.getByRole("button", { name: "Stop the sweep" }).click();
  const progress = await page.getByText(/of 10000 runs, stopped/).textContent();
  assert.ok(Number.parseInt(progress, 10) > 0, progress);
  await page.getByRole("button", { name: "Open as it is" }).click();
  await page.getByText("The run is open in the viewer.").waitFor();
  await page.getByRole("heading", { name: "Possible causes" }).waitFor();
  assert.deepEqual(faults(), []);
  await context.close();
});

test("a project with errors is not swept", async () => {
  const files = { ...FILES, "programs/ordered.starl": "program Ordered\n\nspeak()\n" };
  const { page, context, faults } = await open(files, "worlds/ordered.toml");
  await page.getByRole("button", { name: "Start the sweep" }).click();
  const message = page.getByRole("tabpanel", { name: "Sweep" }).getByRole("alert");
  await message.getByText("Correct the errors of the project first.").waitFor();
  assert.match(await message.textContent(), /ordered\.starl:/);
  assert.deepEqual(faults(), []);
  await context.close();
});
