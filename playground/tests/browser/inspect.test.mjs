// A person looks into a run: robots, properties, messages, plots; steers it, and compares it with another one.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { site, useBrowser, visit } from "./support.mjs";

useBrowser();

/** The world is drawn without a graphics card: a small one costs less time. */
const VIEW = { viewport: { width: 1060, height: 620 } };

/** Opens an example; `until` plays it as fast as it goes until a selector is there. */
async function example(name) {
  const { page, errors, context } = await visit(`${site.url}?example=${name}`, VIEW);
  page.setDefaultTimeout(20_000);
  await page.locator(".play:enabled").waitFor();
  const tab = (label) => page.getByRole("tab", { name: label }).click();
  const play = async () => {
    await page.getByLabel("Speed of playback").selectOption("Infinity");
    await page.locator(".play").click();
  };
  const over = () => page.locator(".transport .outcome").waitFor();
  const end = async () => {
    assert.deepEqual(errors, []);
    await context.close();
  };
  return { page, tab, play, over, end };
}

async function saved(page, button) {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: button }).click(),
  ]);
  return readFileSync(await download.path(), "utf8");
}

test("variables of a chosen robot are shown, and marked when they change", async () => {
  const { page, tab, end } = await example("race");
  await tab("Robots");
  await page.getByRole("option", { name: /iRobot0/ }).click();
  const row = page.locator(".looked tr", {
    has: page.getByRole("rowheader", { name: "currentIndex", exact: true }),
  });
  const changed = row.locator("td.changed", { hasText: "was 0" });
  for (let events = 0; (await changed.count()) === 0; events++) {
    assert.ok(events < 40, "the variable never changed");
    await page.getByRole("button", { name: "To the next event" }).click();
    await page.waitForTimeout(50);
  }
  assert.match(await row.textContent(), /1 was 0/);
  await end();
});

test("a violation leads to its moment and to what could have caused it", async () => {
  const { page, tab, play, over, end } = await example("race");
  await tab("Steer");
  await page.locator(".steer summary", { hasText: "World" }).click();
  for (const [label, value] of [
    ["x, m", "0.7"],
    ["y, m", "-0.5"],
    ["radius, m", "0.3"],
  ]) {
    const field = page
      .locator(".steer details", { hasText: "Add" })
      .getByLabel(label, { exact: true })
      .first();
    await field.fill(value);
  }
  await page.getByRole("button", { name: "Add", exact: true }).click();
  await page.getByText("add an obstacle. It takes effect in the next step").waitFor();
  await play();
  await over();
  const scenario = await saved(page, "Save as scenario");
  assert.match(scenario, /kind = "add_obstacle"/);

  await tab(/Properties/);
  await page.getByText("reach_avoid.safety violated").first().waitFor();
  const finish = Number.parseFloat(await page.locator(".clock").textContent());
  await page.getByRole("listbox", { name: "Violations" }).getByRole("option").first().click();
  await page.getByRole("heading", { name: "Possible causes" }).waitFor();
  assert.ok(Number.parseFloat(await page.locator(".clock").textContent()) < finish);
  assert.ok(
    (await page
      .getByRole("listbox", { name: /causal past/ })
      .getByRole("option")
      .count()) > 3,
  );
  await page.getByRole("button", { name: "Show it in the diagram" }).click();
  await page.getByRole("button", { name: "Remove the marks of the causal past" }).waitFor();
  await end();
});

test("a robot crashes and restarts by its buttons", async () => {
  const { page, tab, end } = await example("race");
  await tab("Robots");
  const robot = page.getByRole("option", { name: /quadcopter0/ });
  await robot.click();
  await page.getByRole("button", { name: "Crash quadcopter0" }).click();
  await page.getByRole("button", { name: "To the next event" }).click();
  await robot.getByText("down").waitFor();
  await page.getByRole("button", { name: "Restart quadcopter0" }).click();
  await page.getByRole("button", { name: "To the next event" }).click();
  await robot.getByText("running").waitFor();
  await end();
});

test("a run stops where an expression over all robots becomes true; a wrong breakpoint says what there is", async () => {
  const { page, tab, play, end } = await example("race");
  await tab("Breakpoints");
  const panel = page.getByRole("tabpanel", { name: "Breakpoints" });
  const add = panel.getByRole("button", { name: "Add", exact: true });
  await panel.getByLabel("Name of the action").fill("jump");
  await add.click();
  await panel.getByRole("alert").getByText('no program of the scenario has the action "jump"').waitFor();
  await panel.getByLabel("Stop at").selectOption("when");
  await panel.getByRole("alert").waitFor({ state: "detached" });
  await panel.getByLabel("Expression, as in").fill("exists r: r.currentIndexes > 1");
  await add.click();
  await panel.getByRole("alert").getByText("currentIndex").last().waitFor();
  await panel.getByLabel("Expression, as in").fill("exists r: r.currentIndex > 1");
  await add.click();
  const remove = panel.getByRole("button", { name: "Remove the breakpoint" });
  await remove.waitFor();
  const { height } = await remove.boundingBox();
  assert.ok(height < 34, `the button's text stands on one line: ${height} px`);
  await play();
  await panel.getByText("(stopped here)").waitFor();
  const stopped = Number.parseFloat(await page.locator(".clock").textContent());
  assert.ok(stopped > 1 && stopped < 60, `stopped at ${stopped} s`);
  await remove.click();
  await page.locator(".play:enabled").click();
  await page.locator(".transport .outcome.reached").waitFor();
  await end();
});

test("messages are found by keyboard, with where they went", async () => {
  const { page, tab, play, over, end } = await example("messages");
  await play();
  await over();
  await tab("Messages");
  await page.getByRole("button", { name: "To the start" }).click();
  await page.waitForFunction(() => Number.parseFloat(document.querySelector(".clock").textContent) === 0);
  await page.getByRole("application", { name: /Messages between robots/ }).focus();
  const details = page.locator(".messages .details");
  for (let presses = 0; !(await details.textContent()).includes("Payload"); presses++) {
    assert.ok(presses < 100, "no message was found");
    await page.keyboard.press("ArrowDown");
  }
  assert.match(await details.textContent(), /bytes[\s\S]*delivered to robot\d[\s\S]*ms/);
  await end();
});

test("the log is searched and leads to moments", async () => {
  const { page, tab, play, over, end } = await example("race");
  await play();
  await over();
  await tab("Log");
  await page.getByLabel("Search the events").fill("done");
  const lines = page.getByRole("listbox", { name: "Events" }).getByRole("option");
  await page.getByText(/^[1-9]\d* of/).waitFor();
  const time = Number.parseFloat(await lines.first().textContent());
  await lines.first().click();
  await page.waitForFunction(
    (time) => Math.abs(Number.parseFloat(document.querySelector(".clock").textContent) - time) < 0.1,
    time,
  );
  await end();
});

test("plots are saved as tables and pictures", async () => {
  const { page, tab, play, over, end } = await example("race");
  await play();
  await over();
  await tab("Plots");
  await page.locator(".picture img").waitFor();
  assert.match(await saved(page, "Save as SVG"), /^<svg[\s\S]*iRobot0[\s\S]*<\/svg>$/);
  await page.locator(".plots select").first().selectOption("speed");
  await page.locator(".time-plot canvas").waitFor();
  const table = (await saved(page, "Save as CSV")).split("\r\n");
  assert.equal(table[0], 'series,"time, s","speed, m/s"');
  assert.ok(table.filter((row) => row.startsWith("quadcopter1,")).length > 100);
  await end();
});

test("two seeds part at their first difference", async () => {
  const { page, tab, play, over, end } = await example("race");
  await play();
  await over();
  await tab("Compare");
  await page.getByRole("button", { name: "Keep this run" }).waitFor();
  const [keep, compare] = await page.locator(".compare .acts button").all();
  const [one, two] = [await keep.boundingBox(), await compare.boundingBox()];
  const apart = two.x - one.x - one.width >= 4 || two.y - one.y - one.height >= 4;
  assert.ok(apart, "the buttons stand apart though no other panel was shown");
  await page.getByLabel("Another seed").fill("1");
  await page.getByRole("button", { name: "Compare with this seed" }).click();
  await page.getByText(/No record differs/).waitFor();
  await page.getByLabel("Another seed").fill("2");
  await page.getByRole("button", { name: "Compare with this seed" }).click();
  await page.getByRole("heading", { name: /The first difference is at/ }).waitFor();
  const differing = page.locator(".sides .differs .what");
  assert.equal(await differing.count(), 2);
  for (const text of await differing.all()) {
    const cut = await text.evaluate((element) => element.scrollHeight > element.clientHeight + 1);
    assert.equal(cut, false, "the text that differs is shown whole");
  }
  await end();
});
