// Fingers on a small screen: the world and the space-time diagram move and zoom, and the page itself does not.

import assert from "node:assert/strict";
import { test } from "node:test";
import { site, useBrowser, visit } from "./support.mjs";

useBrowser();

const PHONE = { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true };

/** Moves fingers from places to others. */
async function fingers(page, from, to) {
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) =>
    session.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map(([x, y], id) => ({ x, y, id })),
    });
  await touch("touchStart", from);
  for (let share = 0.1; share < 1.01; share += 0.1) {
    const between = from.map(([x, y], index) => [
      x + (to[index][0] - x) * share,
      y + (to[index][1] - y) * share,
    ]);
    await touch("touchMove", between);
  }
  await touch("touchEnd", []);
}

const middle = ({ x, y, width, height }) => [x + width / 2, y + height / 2];
const still = async (page) =>
  assert.deepEqual(await page.evaluate(() => [scrollX, scrollY, visualViewport.scale]), [0, 0, 1]);

/** How long a metre is, from the scale in the corner; the text is drawn, so the calls that draw it are heard. */
async function scale(page, act) {
  await page.evaluate(() => {
    globalThis.scale = "";
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
      if (/^[\d.]+ (mm|cm|m|km)$/.test(text)) globalThis.scale = text;
      return fillText.call(this, text, ...place);
    };
  });
  await act();
  await page.waitForFunction(() => globalThis.scale !== "");
  return page.evaluate(() => globalThis.scale);
}

test("two fingers zoom the world, and one moves it", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`, PHONE);
  await page.locator(".play:enabled").waitFor();
  await page.getByRole("button", { name: "From above" }).tap();
  await page.waitForTimeout(500);
  const [x, y] = middle(await page.getByRole("application").boundingBox());
  const zoomed = await scale(page, () =>
    fingers(
      page,
      [
        [x - 30, y],
        [x + 30, y],
      ],
      [
        [x - 120, y],
        [x + 120, y],
      ],
    ),
  );
  assert.match(zoomed, / cm$/, "from 1 m to less");
  await fingers(page, [[x, y]], [[x + 80, y + 60]]);
  await still(page);
  assert.deepEqual(errors, []);
  await context.close();
});

test("fingers scroll and zoom the space-time diagram", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`, PHONE);
  await page.locator(".play:enabled").waitFor();
  await page.getByLabel("Speed of playback").selectOption("Infinity");
  await page.locator(".play").tap();
  await page.locator(".transport .outcome").waitFor();
  await page.getByRole("button", { name: "Inspect" }).tap();
  await page.getByRole("tab", { name: "Messages" }).tap();
  const canvas = page.locator(".diagram canvas");
  const [x, y] = middle(await canvas.boundingBox());
  assert.equal(await page.getByRole("checkbox", { name: "Follow" }).isChecked(), true);
  // At the start of the run the first label stands just below the names of robots.
  await page.evaluate(() => {
    globalThis.labels = new Map();
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...place) {
      if (/ s$/.test(text)) globalThis.labels.set(text, place[1]);
      return fillText.call(this, text, ...place);
    };
  });
  await page.getByLabel("To the start").tap();
  await page.waitForFunction(() => [...globalThis.labels.keys()].some((label) => /^0(\.0+)? s$/.test(label)));
  const top = await page.evaluate(() => Math.min(...globalThis.labels.values()));
  assert.ok(top >= 32, `a label at ${top} px would be hidden`);
  await fingers(page, [[x, y + 120]], [[x, y - 160]]);
  await page.waitForFunction(() => [...globalThis.labels.keys()].some((label) => parseFloat(label) > 2));
  assert.equal(await page.getByRole("checkbox", { name: "Follow" }).isChecked(), false);
  const before = await page.evaluate(() => globalThis.labels.size);
  await fingers(
    page,
    [
      [x, y - 20],
      [x, y + 20],
    ],
    [
      [x, y - 140],
      [x, y + 140],
    ],
  );
  await page.waitForFunction((before) => globalThis.labels.size > before, before);
  await still(page);
  assert.deepEqual(errors, []);
  await context.close();
});
