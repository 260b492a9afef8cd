// Writing programs in the page: examples, errors as they are typed, files that are kept, links, and the scenario.

import assert from "node:assert/strict";
import { test } from "node:test";
import { revisit, site, tab, useBrowser, visit } from "./support.mjs";

useBrowser();

const open = async (address = "", options = {}) => {
  const visited = await visit(site.url + address, options);
  await visited.page.waitForSelector(".bench");
  return { ...visited, faults: () => visited.errors };
};
const editor = (page) => page.locator(".cm-content");
const problems = (page) => page.locator(".problems li");

/** Waits for a condition. The policy of the page lets no text be evaluated in it. */
async function until(page, holds) {
  for (let tries = 0; tries < 100; tries++) {
    if (await holds()) return;
    await page.waitForTimeout(50);
  }
  assert.fail("this does not come true");
}

/** A file as the browser keeps it, once it has this in it. */
async function kept(page, path, part) {
  const found = await page.waitForFunction(
    ([path, part]) => {
      const [latest] = JSON.parse(localStorage.getItem("starl.projects") ?? "[]");
      const text = latest && JSON.parse(localStorage.getItem(`starl.project.${latest.id}`)).files[path];
      return text?.includes(part) ? text : null;
    },
    [path, part],
  );
  return found.jsonValue();
}

/** Opens an example from the gallery and waits for its run. */
async function example(page, title) {
  await page.locator(".card", { has: page.getByText(title, { exact: true }) }).click();
  await page.waitForFunction((title) => document.querySelector("h1")?.textContent === title, title);
}

test("an example opens with its files and runs", async () => {
  const { page, context, faults } = await open();
  await page.locator(".card").first().waitFor();
  assert.equal(await page.locator(".card:not(:has(img))").count(), 0, "each card has a picture");
  await example(page, "Race");
  await page.waitForSelector(".cm-content");
  assert.match(await editor(page).textContent(), /program Race/);
  await page.waitForFunction(() => parseFloat(document.querySelector(".clock").textContent) > 0.2);
  assert.deepEqual(faults(), []);
  await context.close();
});

/** Presses Run once, as soon as a run is being opened. */
function pressWhileItOpens() {
  new MutationObserver((_, observer) => {
    const button = document.querySelector('.run[aria-busy="true"]');
    if (!button) return;
    observer.disconnect();
    button.click();
  }).observe(document, { subtree: true, childList: true, attributes: true });
}

test("Run works while the page still opens the last project", async () => {
  const files = { "hello.starl": "program Hello\n\ngo()\n    pre false\n    eff finish()\n" };
  const project = { name: "Hello", files, scenario: null };
  const { page, context, errors } = await revisit(site.url, project, { script: pressWhileItOpens });
  await page.waitForFunction(() => parseFloat(document.querySelector(".clock")?.textContent) > 0.2);
  assert.deepEqual(errors, []);
  await context.close();
});

test("the gallery shows the tasks for learning with their code", async () => {
  const { page, context, faults } = await open();
  const section = page.locator(".gallery section", { hasText: "Learning tasks, in Python" });
  await section.locator(".card").nth(5).waitFor();
  assert.equal(await section.locator(".card").count(), 6);
  await section.locator(".card", { hasText: "Navigation" }).click();
  const dialog = page.getByRole("dialog", { name: "Navigation" });
  await dialog.getByText("Tasks run in Python").waitFor();
  assert.match(await dialog.locator("pre").textContent(), /reward = "distance\(previous\.position, goal\)/);
  await until(page, () => dialog.locator("img").evaluate((image) => image.naturalWidth > 0));
  await dialog.getByLabel("Close").click();
  assert.deepEqual(faults(), []);
  await context.close();
});

test("an error is marked while it is typed, does not end the run that is shown, and can be undone", async () => {
  const { page, context, faults } = await open("?example=race");
  await editor(page).click();
  await page.keyboard.press("Control+Home");
  await page.keyboard.type("foo ");
  await page.waitForSelector(".cm-lintRange-error");
  assert.match(await problems(page).first().textContent(), /race\.starl:1/);
  await page.keyboard.press("Control+Enter");
  await page.getByRole("alert").getByText("Not run: 3 errors").waitFor();
  assert.equal(await page.locator("h1").textContent(), "Race");
  await editor(page).click();
  await page.keyboard.press("Control+z");
  await page.getByText("No problems").waitFor();
  await page.getByText("Not run").waitFor({ state: "detached" });
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await page.waitForFunction(() => parseFloat(document.querySelector(".clock").textContent) > 0.2);
  assert.deepEqual(faults(), []);
  await context.close();
});

test("what is written is there after a reload, and beside other projects", async () => {
  const { page, context } = await open();
  await page.getByRole("button", { name: "New program" }).click();
  await page.waitForSelector(".cm-content");
  await editor(page).click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("// mine");
  await page.getByLabel("Name of the project").fill("Kept");
  await page.getByLabel("Name of the project").press("Enter");
  await page.reload();
  await page.waitForSelector(".cm-content");
  assert.match(await editor(page).textContent(), /\/\/ mine/);
  await tab(page, "Examples");
  await example(page, "Line");
  await tab(page, "Examples");
  await page.getByRole("button", { name: /^Kept/ }).click();
  await page.waitForFunction(() =>
    document.querySelector(".code-pane")?.shadowRoot?.textContent.includes("// mine"),
  );
  await context.close();
});

test("a link brings a project to another browser, which asks first", async () => {
  const { page, context } = await open("?example=maze");
  await page.getByRole("button", { name: "Share" }).click();
  const link = await page.getByLabel("Link").inputValue();
  await context.close();
  const other = await open(link.slice(link.indexOf("#")));
  await other.page.getByRole("heading", { name: 'Open "Maze"?' }).waitFor();
  assert.ok(!other.page.url().includes("#"), "the link is taken out of the address");
  await other.page.getByRole("button", { name: "Open", exact: true }).click();
  await other.page.waitForFunction(() => document.querySelector("h1")?.textContent === "Maze");
  assert.match(await editor(other.page).textContent(), /program Maze/);
  assert.deepEqual(other.faults(), []);
  await other.context.close();
});

test("a damaged link gives a message and leaves the page as it is", async () => {
  const { page, context, faults } = await open("#p=1.AAAA-damaged");
  await page.getByRole("alert").getByText("This link is damaged").waitFor();
  await page.getByRole("button", { name: "Close", exact: true }).last().click();
  await page.locator("dialog").waitFor({ state: "detached" });
  assert.deepEqual(faults(), []);
  await context.close();
});

test("what is drawn on the map is in the text, and the other way round", async () => {
  const { page, context, faults } = await open("?example=line");
  await tab(page, "Scenario");
  await page.waitForSelector(".text-side .cm-content");
  const before = await page.locator(".map .item.way-point").count();
  await page.getByRole("button", { name: "Waypoint" }).click();
  const box = await page.locator(".map svg").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await until(page, async () => (await page.locator(".map .item.way-point").count()) === before + 1);
  await page.waitForFunction(() =>
    document.querySelector(".text-side .code-pane")?.shadowRoot?.textContent.includes("way_point"),
  );
  await page.getByRole("button", { name: "Undo" }).click();
  await page.waitForFunction(
    (count) => document.querySelectorAll(".map .item.way-point").length === count,
    before,
  );
  assert.deepEqual(faults(), []);
  await context.close();
});

test("the form changes the text, and says what is wrong with a value", async () => {
  const { page, context, faults } = await open("?example=race");
  await tab(page, "Scenario");
  await page.locator("summary", { hasText: "Network" }).click();
  const loss = page.locator("#field-network-loss");
  const write = async (text) => {
    await loss.fill(text);
    await loss.press("Tab");
  };
  await write("30 %");
  assert.match(await kept(page, "race.toml", "loss"), /jitter = "5ms"\nloss = "30 %"\n/);
  await write("3");
  await page.locator("#field-network-loss-about", { hasText: "not a probability" }).waitFor();
  await write("");
  await page
    .locator("#field-network-loss-about", { hasText: "A datagram is lost" })
    .waitFor({ state: "attached" });
  assert.equal(await loss.getAttribute("placeholder"), "0");
  assert.deepEqual(faults(), []);
  await context.close();
});

test("the language's tools work in the editor", async () => {
  const { page, context, faults } = await open("?example=race");
  await editor(page).getByText("ReachAvoid", { exact: true }).hover();
  await page.locator(".cm-tooltip-hover").waitFor();
  // The text that was shown is gone once the mouse is elsewhere.
  await page.mouse.move(900, 10);
  await page.locator(".cm-tooltip-hover").waitFor({ state: "detached" });
  await page.getByLabel("Go to", { exact: true }).selectOption({ label: "pick (action)" });
  await page.keyboard.press("End");
  await page.keyboard.type("   ");
  await page.getByRole("button", { name: "Format" }).click();
  const ends = () =>
    [...document.querySelector(".code-pane").shadowRoot.querySelectorAll(".cm-line")].some((line) =>
      /pick\(\) +$/.test(line.textContent),
    );
  await until(page, async () => !(await page.evaluate(ends)));
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\nx: Int = motion.");
  await page.locator(".cm-tooltip-autocomplete").waitFor();
  assert.deepEqual(faults(), []);
  await context.close();
});
