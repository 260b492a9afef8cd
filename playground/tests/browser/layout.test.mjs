// Large and small screens: nothing is squeezed, cut off, or left out.

import assert from "node:assert/strict";
import { test } from "node:test";
import { site, useBrowser, visit } from "./support.mjs";

useBrowser();

const PHONE = { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true };

test("a small screen begins with the examples, and shows the world once there is a run", async () => {
  const { page, context, errors } = await visit(site.url, PHONE);
  await page.locator(".card", { has: page.getByText("Race", { exact: true }) }).tap();
  await page.getByRole("application").waitFor();
  await page.locator(".play", { hasText: "Pause" }).waitFor();
  assert.deepEqual(errors, []);
  await context.close();
});

test("names of robots and of the project are whole, and the timeline names its lanes", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=search`);
  await page.locator(".play:enabled").waitFor();
  const cut = (element) => element.scrollWidth > element.clientWidth + 1;
  assert.equal(await page.getByLabel("Name of the project").evaluate(cut), false, "name of the project");
  const rows = page.getByRole("listbox", { name: "Robots" }).locator(".grow:first-of-type, .swatch + .grow");
  for (const row of await rows.all()) assert.equal(await row.evaluate(cut), false, await row.textContent());
  const lanes = await page.locator(".timeline li").allTextContents();
  assert.deepEqual(lanes, ["Violations", "Faults", "Programs", "Primitives", "Log"]);
  assert.deepEqual(errors, []);
  await context.close();
});

test("fields keep their room, whatever panels were shown before", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`);
  await page.locator(".play:enabled").waitFor();
  // Each panel brings a style sheet of its own.
  for (const name of await page.getByRole("tab").allTextContents()) {
    await page.getByRole("tab", { name, exact: true }).click();
    await page.getByRole("tabpanel", { name, exact: true }).waitFor();
  }
  for (const name of ["Steer", "Breakpoints", "Compare", "Plots", "Scenario", "Sweep"]) {
    await page.getByRole("tab", { name, exact: true }).click();
    const panel = page.getByRole("tabpanel", { name, exact: true });
    await panel.locator("input:visible, select:visible").first().waitFor();
    for (const field of await panel.locator("input:not([type=checkbox]):visible, select:visible").all()) {
      const { width } = await field.boundingBox();
      assert.ok(width >= 50, `${name}: ${await field.evaluate(({ outerHTML }) => outerHTML)}: ${width} px`);
    }
  }
  assert.deepEqual(errors, []);
  await context.close();
});
