// The gallery has a picture of every example.

import { existsSync, readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { load } from "../../../apps/starl-wasm/starl.mjs";

test("every example has a picture; `npm run pictures` draws them", async () => {
  const starl = await load(readFileSync(new URL("../../wasm/starl.wasm", import.meta.url)));
  const pictureOf = (name: string) => new URL(`../../src/gallery/pictures/${name}.svg`, import.meta.url);
  const without = starl.examples().filter(({ name }) => !existsSync(pictureOf(name)));
  expect(without.map(({ name }) => name)).toEqual([]);
});
