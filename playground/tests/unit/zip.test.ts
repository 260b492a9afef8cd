// Archives of files: the order stays, and a hostile one cannot fill the memory.

import { expect, test } from "vitest";
import { unzip, zip } from "../../src/share/zip.ts";

const MOST = 2_000_000;
const text = (bytes: Uint8Array | undefined) => new TextDecoder().decode(bytes);

test("files come back in their order", () => {
  const files = unzip(zip({ "steered.toml": "a", "race.toml": "b", "worlds/four.wpt": "c" }), MOST);
  expect(Object.keys(files)).toEqual(["steered.toml", "race.toml", "worlds/four.wpt"]);
  expect(text(files["worlds/four.wpt"])).toBe("c");
});

test("an archive that unpacks to more than the limit is refused", () => {
  const half = "a".repeat(MOST / 2 + 1);
  expect(() => unzip(zip({ "a.toml": half, "b.toml": half }), MOST)).toThrow("more than 2 MB");
});

test("a file that is larger than the archive says is cut or refused", () => {
  const archive = zip({ "a.toml": "a".repeat(3_000_000) });
  // The size in the central directory, behind its signature: APPNOTE.TXT 4.3.12.
  const view = new DataView(archive.buffer);
  let at = archive.length - 4;
  while (view.getUint32(at, true) !== 0x02014b50) at--;
  view.setUint32(at + 24, 10, true);
  let length = 0;
  try {
    length = unzip(archive, MOST)["a.toml"]?.length ?? 0;
  } catch {}
  expect(length).toBeLessThanOrEqual(10);
});

test("other bytes are refused", () => {
  expect(() => unzip(new Uint8Array(100), MOST)).toThrow();
});
