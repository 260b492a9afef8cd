// The scenario of the project: its text, what it says, and changes of it. The text is the one truth.

import { computed, signal } from "@preact/signals";
import { parse } from "smol-toml";
import { project, setText } from "../project/project.ts";
import type { Table } from "./table.ts";
import { remove, set, type Toml } from "./toml/edit.ts";
import type { Path } from "./toml/layout.ts";

export const path = computed(() => project.value.scenario);
export const text = computed(() => (path.value === null ? "" : (project.value.files[path.value] ?? "")));

/** Null while the text is not TOML. */
export const content = computed<Table | null>(() => {
  try {
    return parse(text.value, { integersAsBigInt: "asNeeded" }) as Table;
  } catch {
    return null;
  }
});

/** Why the last change could not be made. */
export const refused = signal<string | null>(null);

export function edit(change: (text: string) => string): void {
  if (path.value === null || content.value === null) return;
  try {
    const after = change(text.value);
    // A text that could be read stays one that can.
    parse(after, { integersAsBigInt: "asNeeded" });
    setText(path.value, after);
    refused.value = null;
  } catch {
    refused.value = "The form cannot make this change. Make it in the text below.";
  }
}

export const put = (path: Path, value: Toml | undefined): void =>
  edit((text) => (value === undefined ? remove(text, path) : set(text, path, value)));
