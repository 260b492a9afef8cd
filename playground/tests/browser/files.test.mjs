// Files of the person's machine: traces are shown, programs become a project, and whatever is wrong gives a message.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { site, tab, useBrowser, visit } from "./support.mjs";

useBrowser();

const title = (page, text) =>
  page.waitForFunction((text) => document.querySelector("h1")?.textContent === text, text);
const file = (name, content) => ({
  name,
  mimeType: "application/octet-stream",
  buffer: Buffer.from(content),
});

async function saved(page) {
  await page.locator(".play:enabled").waitFor();
  await page.getByLabel("Speed of playback").selectOption("Infinity");
  await page.locator(".play").click();
  await page.locator(".transport .outcome").waitFor();
  await tab(page, "Properties");
  const saving = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save as trace" }).click();
  return readFileSync(await (await saving).path());
}

test("a saved trace opens in the page without the command, by the button or dropped", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`, {
    acceptDownloads: true,
  });
  const trace = await saved(page);
  await tab(page, "Examples");
  await page.getByLabel("Files to open").setInputFiles(file("race.mcap", trace));
  await title(page, "race.mcap");
  await page.getByLabel("To the furthest known moment").click();
  await page.locator(".transport .outcome.reached").waitFor();
  await tab(page, "Robots");
  await page.getByRole("listbox", { name: "Robots" }).getByRole("option").first().click();
  await page.getByRole("button", { name: "Run it again here" }).click();
  await title(page, "race.mcap, run again");

  const dropped = await page.evaluateHandle((text) => {
    const transfer = new DataTransfer();
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    transfer.items.add(new File([bytes], "dropped.mcap"));
    return transfer;
  }, trace.toString("base64"));
  await page.dispatchEvent("body", "dragenter", { dataTransfer: dropped });
  await page.getByText("Nothing is uploaded.").last().waitFor();
  await page.dispatchEvent(".gallery", "drop", { dataTransfer: dropped });
  await title(page, "dropped.mcap");
  await page.locator(".drop-place").waitFor({ state: "detached" });
  assert.deepEqual(errors, []);
  await context.close();
});

test("files that are no traces or programs give one message, and the run that is shown stays", async () => {
  const { page, context, errors } = await visit(`${site.url}?example=race`, {
    acceptDownloads: true,
  });
  const trace = await saved(page);
  await tab(page, "Examples");
  const field = page.getByLabel("Files to open");
  const cases = [
    [[file("x.mcap", "hello")], /x\.mcap: this file is no trace of StarL/],
    [[file("x.mcap", trace.subarray(0, 200))], /x\.mcap: this file is no trace of StarL/],
    [[file("a.mcap", trace), file("b.mcap", trace)], /one trace at a time/],
    [[file("x.starl", Uint8Array.of(255, 254, 0))], /x\.starl: this is not a text file/],
    [[file("x.txt", "hello")], /Open a trace \(\.mcap\), a program/],
    [[file("x.starl", "a".repeat(2_100_000))], /larger than 2 MB/],
  ];
  for (const [files, message] of cases) {
    await field.setInputFiles(files);
    const alert = page.getByRole("alert");
    await alert.getByText(message).waitFor();
    assert.equal(await alert.count(), 1);
    await page.getByLabel("Close the message").click();
  }
  assert.equal(await page.locator("h1").textContent(), "Race");
  await page.getByLabel("To the start").click();
  await page.waitForFunction(() => document.querySelector(".clock").textContent.startsWith("0.00 s"));

  // Damage in the middle is reported, and the part before it is shown.
  const damaged = Buffer.from(trace);
  damaged[Math.floor(damaged.length * 0.6)] ^= 0x10;
  await field.setInputFiles(file("damaged.mcap", damaged));
  await title(page, "damaged.mcap");
  await page
    .getByRole("alert")
    .getByText(/damaged\.mcap: the trace is damaged after [\d.]+ s/)
    .waitFor();
  assert.deepEqual(errors, []);
  await context.close();
});

test("a program and a scenario become a project", async () => {
  const { page, context, errors } = await visit(site.url);
  await page.locator(".card").first().waitFor();
  await page
    .getByLabel("Files to open")
    .setInputFiles([
      file("walk.starl", "program Walk\n\ngo()\n    pre true\n    eff finish()\n"),
      file(
        "walk.toml",
        'title = "A walk"\nprogram = "walk.starl"\nduration = "9s"\n[[robots]]\nmodel = "create"\ncount = 2\narea = { low = [0, 0], high = [4, 4] }\n',
      ),
    ]);
  await title(page, "A walk");
  assert.match(await page.locator(".cm-content").first().textContent(), /program Walk/);
  assert.equal(await page.getByLabel("Name of the project").inputValue(), "walk");
  assert.deepEqual(errors, []);
  await context.close();
});
