import { deflateSync, strToU8 } from "fflate";
import { describe, expect, test } from "vitest";
import * as base64 from "../../src/share/base64.ts";
import { BadLink, read, write } from "../../src/share/link.ts";

const PROJECT = {
  name: "Größe – 大きさ",
  files: { "a.starl": "program A\n", "worlds/room.wpt": "WAY,1,2,0,A\n", "a.toml": 'program = "a.starl"\n' },
  scenario: "a.toml",
  active: "a.starl",
  seed: "7",
};

const pack = (content: unknown) => `p=1.${base64.encode(deflateSync(strToU8(JSON.stringify(content))))}`;

test("a project comes back from its link as it was", () => {
  expect(read(write(PROJECT))).toEqual(PROJECT);
});

test("a link has only characters that addresses keep", () => {
  expect(write(PROJECT)).toMatch(/^p=1\.[A-Za-z0-9_-]+$/);
});

describe("a damaged link is refused with a message", () => {
  const link = write(PROJECT);
  test.each([
    ["cut anywhere", [...Array(link.length - 1).keys()].map((length) => link.slice(0, length))],
    ["other characters", [link.replace(/.$/, "!"), `${link}%00`, `${link} `]],
    ["no data", ["p=", "p=1", "p=1.", "p=.x", "p=x.x"]],
  ])("%s", (_, links) => {
    for (const damaged of links) expect(() => read(damaged), damaged).toThrow(BadLink);
  });

  test("any one character changed never gives anything but a project or a message", () => {
    for (let at = 4; at < link.length; at++) {
      const changed = link.slice(0, at) + (link[at] === "A" ? "B" : "A") + link.slice(at + 1);
      try {
        expect(Object.keys(read(changed).files).length).toBeGreaterThan(0);
      } catch (error) {
        expect(error).toBeInstanceOf(BadLink);
      }
    }
  });
});

describe("a hostile link is refused", () => {
  test("that unpacks to more than 2 MB, soon and without much memory", () => {
    const began = performance.now();
    const bomb = `p=1.${base64.encode(deflateSync(new Uint8Array(20_000_000), { level: 9 }))}`;
    const packed = performance.now();
    expect(() => read(bomb)).toThrow("2 MB");
    expect(performance.now() - packed).toBeLessThan(Math.max(500, packed - began));
  });

  test.each([
    "../secret.starl",
    "/etc/passwd",
    "a//b.starl",
    "a\\b.starl",
    "C:a.starl",
    "a/./b.starl",
    "",
    "constructor",
    "\u202ea.starl",
    "x".repeat(200),
  ])("with a file called %j", (path) => {
    expect(() => read(pack({ name: "x", files: { [path]: "" } }))).toThrow("not allowed");
  });

  test("with too many files", () => {
    const files = Object.fromEntries(Array.from({ length: 65 }, (_, index) => [`${index}.starl`, ""]));
    expect(() => read(pack({ name: "x", files }))).toThrow("more than 64 files");
  });

  test.each([
    null,
    1,
    [],
    {},
    { name: 1, files: {} },
    { name: "x", files: [] },
    { name: "x", files: { "a.starl": 1 } },
  ])("with content of another shape: %j", (content) => {
    expect(() => read(pack(content))).toThrow(BadLink);
  });

  test("from another version", () => {
    expect(() => read("p=2.abc")).toThrow("another version");
  });

  test("and a scenario that is none of its files is ignored", () => {
    expect(
      read(pack({ name: "x", files: { "a.starl": "" }, scenario: "../b.toml", active: 5, seed: "1e9" })),
    ).toMatchObject({
      scenario: null,
      active: "a.starl",
      seed: "",
    });
  });
});
