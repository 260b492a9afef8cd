// Values for names that the program or the model has: `parameters`.

import { useSignal } from "@preact/signals";
import { put } from "./document.ts";
import { parameterNames } from "./problems.ts";
import { Single } from "./Single.tsx";
import { type Field, labelOf } from "./schema.ts";
import type { Table } from "./table.ts";
import type { Path } from "./toml/layout.ts";

interface Properties {
  field: Field;
  path: Path;
  value: Table;
  model: string | null;
}

export function Parameters({ field, path, value }: Properties) {
  const name = useSignal("");
  const names = Object.keys(value);
  const offered = parameterNames.value.filter((known) => !names.includes(known));
  const id = `new-${path.join("-")}`;
  const add = () => {
    if (!/^[A-Za-z_]\w*$/.test(name.value)) return;
    put([...path, name.value], 0);
    name.value = "";
  };
  return (
    <details class="table" open={names.length > 0 && path.length === 1}>
      <summary>
        {field.label} {names.length > 0 && <span class="badge">{names.length}</span>}
      </summary>
      <p class="muted">{field.about}</p>
      <div class="fields">
        {names.map((known) => (
          <Single
            key={known}
            field={{
              ...field,
              name: known,
              label: labelOf(known),
              kind: "any",
              about: "",
              required: false,
              default: "",
            }}
            path={[...path, known]}
            value={value[known]}
          />
        ))}
      </div>
      <div class="row">
        <input
          aria-label="Name of the parameter"
          list={`${id}-names`}
          placeholder={offered[0] ?? "name"}
          value={name.value}
          onInput={(event) => {
            name.value = event.currentTarget.value.trim();
          }}
        />
        <datalist id={`${id}-names`}>
          {offered.map((known) => (
            <option key={known} value={known} />
          ))}
        </datalist>
        <button type="button" onClick={add}>
          Add parameter
        </button>
      </div>
    </details>
  );
}
