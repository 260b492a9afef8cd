// Programs and worlds that would take all time or memory are stopped with a message, and the page stays usable.

import assert from "node:assert/strict";
import { test } from "node:test";
import { revisit, site, useBrowser } from "./support.mjs";

useBrowser();

const ROBOTS = `program = "hello.starl"
duration = "20s"
[[robots]]
model = "create"
area = { low = [0, 0], high = [400, 400] }
`;
const IDLE = "program Hello\n\ngo()\n    pre false\n    eff finish()\n";
const CASES = [
  [
    "a loop of a billion steps",
    "x: Int = 0\n\ngo()\n    pre true\n    eff\n        for i in 0..1000000000\n            x = 1 - x\n",
    "the activation takes too many instructions",
  ],
  [
    "a list that doubles",
    "list: List[Int] = [1]\n\ngo()\n    pre true\n    eff list = list + list\n",
    "values need more than 1048576 bytes of memory",
  ],
];

const open = (files) =>
  revisit(site.url, { name: "Hello", files, scenario: files["hello.toml"] ? "hello.toml" : null });
const pressRun = (page) => page.getByRole("button", { name: "Run", exact: true }).click();

for (const [what, text, message] of CASES) {
  test(`${what} ends the program`, async () => {
    const { page, context, errors } = await open({ "hello.starl": `program Hello\n\n${text}` });
    await pressRun(page);
    await page.locator(".transport .outcome", { hasText: "Program failed" }).waitFor();
    await page.getByRole("tab", { name: "Log" }).click();
    await page.getByText(message).first().waitFor();
    assert.deepEqual(errors, []);
    await context.close();
  });
}

test("a fleet that the page cannot draw is refused", async () => {
  const files = { "hello.starl": IDLE, "hello.toml": `${ROBOTS}count = 10001\n` };
  const { page, context, errors } = await open(files);
  await pressRun(page);
  await page.getByRole("alert").getByText("There are 10001 robots.").waitFor();
  await page.getByRole("tab", { name: "Log" }).click();
  assert.deepEqual(errors, []);
  await context.close();
});
