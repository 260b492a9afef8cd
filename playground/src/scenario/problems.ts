// The reader's problems of single fields, and the parameters of the program.

import { computed } from "@preact/signals";
import { diagnostics } from "../project/checking.ts";
import { project } from "../project/project.ts";
import { path } from "./document.ts";

/** By the field, as `network.loss`. */
export const complaints = computed(() => {
  const found = new Map<string, string>();
  for (const { file, field, message, help } of diagnostics.value) {
    if (file === path.value && field !== null && !found.has(field))
      found.set(field, help ? `${message}; ${help}` : message);
  }
  return found;
});

/** The names of the parameters that programs of the project declare. */
export const parameterNames = computed(() =>
  Object.values(project.value.files).flatMap((text) =>
    [...text.matchAll(/^param\s+([A-Za-z_]\w*)/gm)].map(([, name]) => name ?? ""),
  ),
);
