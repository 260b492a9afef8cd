// The fields of a table as a form, and a list of tables as a form: robots, waypoints, faults.

import type { JSX } from "preact";
import { edit } from "./document.ts";
import { describe, first, singular, withModel } from "./element.ts";
import { Parameters } from "./Parameters.tsx";
import { type One, Single } from "./Single.tsx";
import { type Field, fieldsOf, type Schema } from "./schema.ts";
import { isTable, type Table, tablesOf } from "./table.ts";
import { append, remove, type Toml } from "./toml/edit.ts";
import type { Path } from "./toml/layout.ts";

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

interface List {
  field: Field;
  table: Schema;
  path: Path;
  values: Table[];
}

function Elements({ field, table, path, values }: List) {
  const fields = fieldsOf(table);
  const one = singular(field.label);
  return (
    <details class="table" open={values.length > 0 && values.length < 4 && path.length === 1}>
      <summary>
        {field.label} {values.length > 0 && <span class="badge">{values.length}</span>}
      </summary>
      <p class="muted">{field.about}</p>
      {values.map((value, index) => {
        const place = [...path, index];
        return (
          <details class="element" key={place.join(".")} open={values.length === 1}>
            <summary>{describe(value, index, one)}</summary>
            <Fields fields={withModel(fields, table, value)} path={place} value={value} />
            <button type="button" onClick={() => edit((text) => remove(text, place))}>
              Remove this {one.toLowerCase()}
            </button>
          </details>
        );
      })}
      <button
        type="button"
        onClick={() => edit((text) => append(text, path, first(field.name, fields, values)))}
      >
        Add {one.toLowerCase()}
      </button>
    </details>
  );
}
