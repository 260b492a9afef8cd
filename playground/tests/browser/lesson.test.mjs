// The first lesson with the page alone, as a newcomer does it: typed, not written by the page.

import assert from "node:assert/strict";
import { test } from "node:test";
import { site, useBrowser, visit } from "./support.mjs";

useBrowser();

test("a newcomer finds the lesson, types an action and a property, and marks places on the map", async () => {
  const { page, context, errors } = await visit(site.url);
  const strip = page.getByRole("region", { name: "Lesson" });
  const editor = page.locator(".cm-content").first();
  const isDone = () => strip.getByText("Done", { exact: true }).waitFor();
  const run = () => page.getByRole("button", { name: "Run", exact: true }).click();
  await page.getByRole("button", { name: "First lesson" }).click();
  await page.getByRole("button", { name: "Begin" }).click();
  await page.getByLabel("Speed of playback").selectOption("Infinity");
  await run();
  await isDone();

  await page.getByRole("tab", { name: "Lesson" }).click();
  await page.getByRole("button", { name: "Write an action" }).click();
  await page.waitForFunction(() =>
    document.querySelector(".code-pane")?.shadowRoot?.textContent.includes("nearest"),
  );
  await editor.focus();
  await page.keyboard.press("Control+End");
  // Enter indents as the language wants it, and on a blank line not at all.
  await page.keyboard.type(
    "\nfinish()\npre loc == choose and open.size() == 0\neff motion.stop(); finish(); loc = done",
  );
  // No line is cut off, and the line that is written stays in view when problems appear.
  const scroller = page.locator(".cm-scroller").first();
  assert.ok(await scroller.evaluate(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth));
  await run();
  await isDone();
  await strip.getByRole("button", { name: "Next" }).click();
  await editor.focus();
  await page.keyboard.press("Control+End");
  await page.keyboard.type(
    "\n\ninvariant once: forall r, s: r.id == s.id or r.found.intersection(s.found).size() == 0",
  );
  await run();
  await isDone();
  // The result of the step is in view, however long its text is.
  const after = await strip.locator(".done").boundingBox();
  const text = await strip.locator(".text").boundingBox();
  assert.ok(after.y + after.height <= text.y + text.height + 1);

  await page.getByRole("tab", { name: "Scenario" }).click();
  const mark = page.locator(".map .item.way-point path").first();
  assert.notEqual(await mark.evaluate((path) => getComputedStyle(path).stroke), "none");
  assert.deepEqual(errors, []);
  await context.close();
});

test("what is written stays in view when problems appear below", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=search`);
  const editor = page.locator(".cm-content").first();
  await page.locator(".play:enabled").waitFor();
  await editor.focus();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\n\nnew()\npre mot");
  await page.locator(".problems li").first().waitFor();
  const isSeen = () => {
    const { shadowRoot } = document.querySelector(".code-pane");
    const cursor = shadowRoot.querySelector(".cm-cursor-primary").getBoundingClientRect();
    return cursor.bottom <= shadowRoot.querySelector(".cm-scroller").getBoundingClientRect().bottom + 1;
  };
  await page.waitForFunction(isSeen);
  await page.locator(".cm-tooltip-autocomplete").getByText("motion", { exact: true }).first().waitFor();
  assert.deepEqual(errors, []);
  await context.close();
});
