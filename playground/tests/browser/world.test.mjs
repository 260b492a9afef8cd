// The world in a browser: it is painted, only when something changes, and answers to the mouse.

import assert from "node:assert/strict";
import { test } from "node:test";
import { site, useBrowser, visit } from "./support.mjs";

useBrowser();

test("the view of the world stands still when nothing happens, and measures with two clicks", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`);
  await page.getByRole("button", { name: "From above" }).click();
  const frames = () =>
    page.evaluate(async () => {
      let count = 0;
      const clear = CanvasRenderingContext2D.prototype.clearRect;
      CanvasRenderingContext2D.prototype.clearRect = function (...box) {
        count++;
        return clear.apply(this, box);
      };
      await new Promise((resolve) => setTimeout(resolve, 1000));
      CanvasRenderingContext2D.prototype.clearRect = clear;
      return count;
    });
  // A slow machine still loads parts of the page at first.
  let seen = await frames();
  for (let tries = 0; tries < 20 && seen > 0; tries++) seen = await frames();
  assert.equal(seen, 0, "no picture without a change");

  await page.getByRole("button", { name: "Measure" }).click();
  await page.getByText("Click the first place.").waitFor();
  const box = await page.getByRole("application").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.getByText("Click the second place.").waitFor();
  await page.mouse.click(box.x + box.width / 2 + 60, box.y + box.height / 2 + 60);
  await page.getByText("Click to measure again.").waitFor();
  await page.keyboard.press("Escape");

  await page.getByRole("button", { name: "Layers" }).click();
  await page.getByLabel("Paths so far").uncheck();
  await page.reload();
  await page.getByRole("button", { name: "Layers" }).click();
  assert.equal(await page.getByLabel("Paths so far").isChecked(), false, "hidden layers are remembered");
  // A static host has no start.json.
  assert.deepEqual(errors, []);
  await context.close();
});

test("the sensors of a chosen robot are drawn, and can be hidden", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=diffusion`);
  await page.locator(".play:enabled").waitFor();
  await page.getByLabel("To the next event").click();
  await page.getByRole("listbox", { name: "Robots" }).getByRole("option").first().click();
  const nearest = page.locator(".looked tr", {
    has: page.getByRole("rowheader", { name: "nearest by proximity" }),
  });
  await nearest.getByText(/^0\.\d+ m at /).waitFor();
  await page.getByRole("button", { name: "Layers" }).click();
  const segments = () =>
    page.evaluate(async () => {
      const pen = CanvasRenderingContext2D.prototype;
      const { lineTo, clearRect } = pen;
      let count = 0;
      // A busy machine takes its time for the next picture.
      const drawn = new Promise((resolve) => {
        pen.clearRect = function (...area) {
          setTimeout(resolve);
          return clearRect.apply(this, area);
        };
      });
      pen.lineTo = function (...to) {
        count++;
        return lineTo.apply(this, to);
      };
      document.querySelector(".world-picture").dispatchEvent(new KeyboardEvent("keydown", { key: "+" }));
      await drawn;
      Object.assign(pen, { lineTo, clearRect });
      return count;
    });
  const shown = await segments();
  await page.getByLabel("Sensors of selected robots").uncheck();
  const left = await segments();
  assert.ok(shown >= left + 12, `${shown} lines with twelve rays, ${left} without`);
  assert.deepEqual(errors, []);
  await context.close();
});
