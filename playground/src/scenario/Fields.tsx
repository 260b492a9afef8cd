// The fields of a table as a form.

import type { JSX } from "preact";
import { useState } from "preact/hooks";
import { put } from "./document.ts";
import { Elements } from "./Elements.tsx";
import { Parameters } from "./Parameters.tsx";
import { complaints } from "./problems.ts";
import { type Field, fieldsOf } from "./schema.ts";
import { isTable, type Table, tablesOf } from "./table.ts";
import type { Toml } from "./toml/edit.ts";
import type { Path } from "./toml/layout.ts";
import { read, show } from "./values.ts";

export interface Place {
  fields: Field[];
  path: Path;
  value: Table;
}

export function Fields({ fields, path, value }: Place) {
  return (
    <div class="fields">
      {fields.map((field) => (
        <AnyField
          key={field.name}
          field={field}
          path={[...path, field.name]}
          value={value[field.name]}
          owner={value}
        />
      ))}
    </div>
  );
}

interface One {
  field: Field;
  path: Path;
  value: Toml | undefined;
}

export function AnyField({ field, path, value, owner }: One & { owner: Table }): JSX.Element {
  if (field.kind === "tables" && field.table) {
    return <Elements field={field} table={field.table} path={path} values={tablesOf(value)} />;
  }
  if (field.kind === "parameters" || field.kind === "model_parameters") {
    const model = typeof owner.model === "string" ? owner.model : null;
    return <Parameters field={field} path={path} value={isTable(value) ? value : {}} model={model} />;
  }
  if (field.table) {
    return (
      <details class="table" open={isTable(value) && path.length > 1}>
        <summary>
          {field.label} <Count value={value} />
        </summary>
        <p class="muted">{field.about}</p>
        {field.kind === "switch" && (
          <Single field={{ ...field, kind: "flag", label: "On" }} path={path} value={value} />
        )}
        <Fields fields={fieldsOf(field.table)} path={path} value={isTable(value) ? value : {}} />
      </details>
    );
  }
  return <Single field={field} path={path} value={value} />;
}

/** How much of a table is set. */
export function Count({ value }: { value: Toml | undefined }) {
  const count = isTable(value) ? Object.keys(value).length : 0;
  return count > 0 ? <span class="badge">{count} set</span> : null;
}

/** A field that is one input. */
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
