import { readdirSync, readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { taskOf } from "../../src/gallery/tasks.ts";

const FOLDER = new URL("../../../apps/starl-py/python/starl/env/tasks/", import.meta.url);
const FILES = readdirSync(FOLDER).filter((name) => name.endsWith(".py") && name !== "__init__.py");

test("every task of the package for Python can be shown", () => {
  expect(FILES.length).toBe(6);
  for (const file of FILES) {
    const task = taskOf(readFileSync(new URL(file, FOLDER), "utf8"));
    expect(`${task.name.toLowerCase()}.py`).toBe(file);
    expect(task.summary).toMatch(/^[A-Z].*\.$/s);
    expect(task.rules.length).toBeGreaterThan(20);
    expect(task.code).toMatch(/^class \w+\(\w+\):\n {4}\w/);
    expect(task.code).not.toContain('"""\n\n');
  }
});
