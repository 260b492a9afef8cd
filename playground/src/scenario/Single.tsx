// A field that is one input.

import { useState } from "preact/hooks";
import { put } from "./document.ts";
import { complaints } from "./problems.ts";
import type { Field } from "./schema.ts";
import { isTable } from "./table.ts";
import type { Toml } from "./toml/edit.ts";
import type { Path } from "./toml/layout.ts";
import { read, show } from "./values.ts";

export interface One {
  field: Field;
  path: Path;
  value: Toml | undefined;
}

export function Single({ field, path, value }: One) {
  const [problem, setProblem] = useState<string | null>(null);
  const id = `field-${path.join("-")}`;
  const change = (text: string) => {
    try {
      put(path, read(field, text));
      setProblem(null);
    } catch (error) {
      setProblem((error as Error).message);
    }
  };
  const said = problem ?? complaints.value.get(path.join(".")) ?? null;
  const common = { id, "aria-invalid": said !== null, "aria-describedby": `${id}-about` };
  const shown = isTable(value) && field.kind === "flag" ? "true" : show(field, value);
  const choices = field.kind === "flag" ? ["true", "false"] : field.choices;
  const isSelect = field.kind === "flag" || field.kind === "choice" || field.kind === "model";
  return (
    <div class="field">
      <label for={id}>{field.label}</label>
      {isSelect ? (
        <select {...common} value={shown} onChange={(event) => change(event.currentTarget.value)}>
          {!field.required && (
            <option value="">{field.default ? `${word(field.default)} (default)` : ""}</option>
          )}
          {shown !== "" && !choices.includes(shown) && <option value={shown}>{shown}</option>}
          {choices.map((choice) => (
            <option key={choice} value={choice}>
              {word(choice)}
            </option>
          ))}
        </select>
      ) : (
        <input
          {...common}
          value={shown}
          placeholder={field.required ? "" : field.default}
          list={field.choices.length > 0 ? `${id}-choices` : undefined}
          spellcheck={false}
          autocomplete="off"
          onChange={(event) => change(event.currentTarget.value)}
        />
      )}
      {!isSelect && field.choices.length > 0 && (
        <datalist id={`${id}-choices`}>
          {field.choices.map((choice) => (
            <option key={choice} value={choice} />
          ))}
        </datalist>
      )}
      <p id={`${id}-about`} class={said ? "error" : "about muted"} role={said ? "alert" : undefined}>
        {said ?? `${field.about} ${hint(field)}`}
      </p>
    </div>
  );
}

const WORDS: Record<string, string> = { true: "yes", false: "no" };
const word = (choice: string) => WORDS[choice] ?? choice;

function hint({ units, limits }: Field): string {
  const named = units.length > 0 ? `Units: ${units.join(", ")}.` : "";
  return limits === "" ? named : `${limits.charAt(0).toUpperCase()}${limits.slice(1)}. ${named}`;
}
