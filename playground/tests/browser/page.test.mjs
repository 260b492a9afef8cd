// The page as a visitor meets it: cold, offline, with the digests of the command, without a request to anyone else, and
// for people who cannot use a mouse or see colours.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";
import { test } from "node:test";
import { promisify } from "node:util";
import { brotliCompress } from "node:zlib";
import { DIST, site, tab, useBrowser, visit } from "./support.mjs";

useBrowser();

const golden = JSON.parse(
  readFileSync(new URL("../../../apps/starl-wasm/golden.json", import.meta.url), "utf8"),
);
/** The digest of Race with seed 1, as the command has it. */
const RACE = golden.find(({ example, set }) => example === "race" && set[0] === "seed=1").digest;
const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

async function playToTheEnd(page) {
  await page.getByLabel("Speed of playback").selectOption("Infinity");
  await page.locator(".play:enabled").click();
  await page.locator(".transport .outcome.reached").waitFor();
}

/** The digest of the moment shown. */
async function digest(page) {
  await tab(page, "Properties");
  const shown = page.locator("dt", { hasText: "Digest" }).locator("+ dd");
  await page.waitForFunction((dd) => /^[0-9a-f]{16}$/.test(dd.textContent), await shown.elementHandle());
  return shown.textContent();
}

test("Race runs from a cold page to its goal, with the digest of the command, and asks no other host", async () => {
  const { page, context, errors } = await visit("about:blank");
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.goto(site.url);
  await page.locator(".card", { has: page.getByText("Race", { exact: true }) }).click();
  await page.waitForFunction(() => document.querySelector("h1")?.textContent === "Race");
  await page.locator(".play", { hasText: "Pause" }).click();
  await playToTheEnd(page);
  assert.equal(await digest(page), RACE);
  const others = asked.filter((url) => !url.startsWith(site.url) && !/^(blob|data|about):/.test(url));
  assert.deepEqual(others, []);
  assert.deepEqual(errors, []);
  await context.close();
});

/** As a host sends it by Brotli. */
const MOST_BYTES = 1_550_000;

test("a first visit is small: it loads neither the painter of runs nor the editor", async () => {
  const { page, context } = await visit("about:blank");
  const loaded = new Set();
  page.on("request", (request) => loaded.add(new URL(request.url()).pathname));
  await page.goto(site.url);
  await page.locator(".card").first().waitFor();
  await context.close();
  // Pictures of examples load as they come into view, and the service worker fetches the rest for later.
  const parts = [...loaded].filter((path) => path !== "/sw.js" && !path.endsWith(".svg"));
  const size = async (path) => {
    const content = await readFile(join(DIST, path === "/" ? "index.html" : path));
    return (await promisify(brotliCompress)(content)).length;
  };
  const sizes = await Promise.all(parts.map(size));
  const whole = sizes.reduce((sum, size) => sum + size, 0);
  assert.ok(
    whole <= MOST_BYTES,
    `${whole} bytes: ${parts.map((path, at) => `${path} ${sizes[at]}`).join(", ")}`,
  );
});

test("steps back and forth lead to the same digest", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`);
  await page.locator(".play:enabled").waitFor();
  const text = () => page.locator(".clock").textContent();
  const moved = (from) =>
    page.waitForFunction((from) => document.querySelector(".clock").textContent !== from, from);
  const go = async (act) => {
    const from = await text();
    await act();
    await moved(from);
  };
  for (let steps = 0; steps < 6; steps++) await go(() => page.keyboard.press("."));
  await go(() => page.getByLabel("To the next event").click());
  const [moment, first] = [await text(), await digest(page)];
  await go(() => page.getByLabel("To the event before").click());
  assert.notEqual(await digest(page), first);
  await go(() => page.getByLabel("To the next event").click());
  assert.equal(await text(), moment);
  assert.equal(await digest(page), first);
  assert.deepEqual(errors, []);
  await context.close();
});

test("once loaded the page works without a network", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`);
  await page.evaluate(() => navigator.serviceWorker.ready.then(() => undefined));
  await page.waitForFunction(async () => (await caches.keys()).length > 0);
  await context.setOffline(true);
  await page.reload();
  await playToTheEnd(page);
  assert.equal(await digest(page), RACE);
  assert.deepEqual(
    errors.filter((error) => !error.includes("ERR_INTERNET_DISCONNECTED")),
    [],
  );
  await context.close();
});

for (const colorScheme of ["light", "dark"]) {
  test(`no part of the page breaks a rule of accessibility in ${colorScheme} colours`, async () => {
    // The check itself is a script that the page's policy would refuse.
    const { page, context } = await visit(`${site.url}?example=race`, {
      colorScheme,
      bypassCSP: true,
    });
    await page.locator(".play:enabled").waitFor();
    await page.getByLabel("To the next event").click();
    await page.evaluate(AXE);
    for (const name of await page.getByRole("tab").allTextContents()) {
      await tab(page, name);
      const { violations } = await page.evaluate(() => globalThis.axe.run());
      const told = violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" | ")}`);
      assert.deepEqual(told, [], name);
    }
    await context.close();
  });
}
