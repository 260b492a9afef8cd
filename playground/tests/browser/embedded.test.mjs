// The page as one file, as notebooks show it: opened from disk, and inside another page. STARL names the command.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { useBrowser, visit } from "./support.mjs";

useBrowser();

const { STARL } = process.env;
const skip = STARL ? false : "STARL names no command";
const at = (path) => new URL(`../../${path}`, import.meta.url);
const packed = (content) => gzipSync(content).toString("base64");

let folder;
let digest;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), "starl-"));
  if (!STARL) return;
  const command = ["run", "race", "--seed", "7", "--json", "--trace", join(folder, "race.mcap")];
  digest = JSON.parse(spawnSync(STARL, command, { encoding: "utf8" }).stdout).digest;
});
after(async () => {
  rmSync(folder, { recursive: true });
});

/** The page with the trace in it. */
function page(live) {
  const run = packed(JSON.stringify({ name: "Race", live }));
  const module = live ? packed(readFileSync(at("wasm/starl.wasm"))) : "";
  const text = readFileSync(at("embedded/viewer.html"), "utf8");
  return text
    .replace("{{RUN}}", run)
    .replace("{{TRACE}}", packed(readFileSync(join(folder, "race.mcap"))))
    .replace("{{MODULE}}", module);
}

/** Writes a page into a file and opens it; inside another page, as a notebook does, if `framed`. */
async function open(content, { framed = false } = {}) {
  const path = join(folder, "page.html");
  const escaped = content.replaceAll("&", "&amp;").replaceAll('"', "&quot;");
  const frame = `<!doctype html><meta charset="utf-8"><iframe srcdoc="${escaped}" width="1300" height="750"></iframe>`;
  writeFileSync(path, framed ? frame : content);
  const visited = await visit(pathToFileURL(path).href);
  return { ...visited, shown: framed ? visited.page.frameLocator("iframe") : visited.page };
}

async function playToTheEnd(shown) {
  await shown.locator(".play:enabled").waitFor();
  await shown.getByLabel("Speed of playback").selectOption("Infinity");
  await shown.locator(".play").click();
  await shown.locator(".transport .outcome.reached").waitFor();
}

async function told(shown) {
  await shown.getByRole("tab", { name: "Properties" }).click();
  const cell = shown
    .locator("dt", { hasText: "Digest" })
    .locator("+ dd")
    .filter({ hasText: /^[0-9a-f]{16}$/ });
  return cell.textContent();
}

test("a recorded run plays from a file on disk, without the module", { skip }, async () => {
  const { shown, context, errors } = await open(page(false));
  await playToTheEnd(shown);
  assert.equal(await shown.locator("h1").textContent(), "Race");
  assert.equal(await told(shown), digest);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a live run is simulated inside another page, with the digest of the command", { skip }, async () => {
  const { shown, context, errors } = await open(page(true), { framed: true });
  await shown.locator("h1", { hasText: "Race, run again" }).waitFor();
  await playToTheEnd(shown);
  assert.equal(await told(shown), digest);
  assert.deepEqual(errors, []);
  await context.close();
});
