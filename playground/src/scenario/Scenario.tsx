// The scenario: drawn, as a form, and as its text. All three show the same.

import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { CodePane, pane } from "../editor/CodePane.tsx";
import { templateOf } from "../editor/templates.ts";
import { pathsOf } from "../project/model.ts";
import { addFile, project } from "../project/project.ts";
import { content, path, refused } from "./document.ts";
import { AnyField, Fields } from "./Fields.tsx";
import { loadSchema, ordered, schema, unavailable } from "./form.ts";
import { WorldMap } from "./map/Map.tsx";
import { complaints } from "./problems.ts";
import "../styles/scenario.css";

const SIDES = [
  ["form", "Form"],
  ["both", "Both"],
  ["text", "Text"],
] as const;

/** Both have too little room on a small screen. */
const first = () => (matchMedia("(max-width: 900px)").matches ? "form" : "both");

export function Scenario() {
  const side = useSignal<(typeof SIDES)[number][0]>(first());
  useEffect(() => {
    void loadSchema();
  }, []);
  const shown = path.value;
  if (shown === null) return <Without />;
  return (
    <div class="scenario" data-side={side.value}>
      <div class="form-side">
        <WorldMap />
        {content.value === null && (
          <p class="error" role="alert">
            The text of {shown} has an error. The form goes on when it is corrected.
          </p>
        )}
        {refused.value && (
          <p class="error" role="alert">
            {refused.value}
          </p>
        )}
        {side.value !== "text" && <Form />}
      </div>
      <div class="row ways">
        <div class="group">
          {SIDES.map(([name, label]) => (
            <button
              key={name}
              type="button"
              aria-pressed={side.value === name}
              onClick={() => {
                side.value = name;
              }}
            >
              {label}
            </button>
          ))}
        </div>
        <button type="button" onClick={() => pane.current?.undo()} title="Take back the last change">
          Undo
        </button>
        <span class="muted">
          {shown}
          {complaints.value.size > 0 && `: ${complaints.value.size} to correct`}
        </span>
      </div>
      <div class="text-side">
        <CodePane key={`${project.value.id}:${shown}`} path={shown} />
      </div>
    </div>
  );
}

function Form() {
  const root = schema.value;
  const value = content.value;
  if (!root)
    return (
      <p class="muted">
        {unavailable.value ? "This simulator has no form. Write the text." : "Loading the form …"}
      </p>
    );
  if (!value) return null;
  const { single, tables } = ordered(root);
  return (
    <form class="form" onSubmit={(event) => event.preventDefault()}>
      <details class="table" open>
        <summary>The run</summary>
        <Fields fields={single} path={[]} value={value} />
      </details>
      {tables.map((field) => (
        <AnyField
          key={field.name}
          field={field}
          path={[field.name]}
          value={value[field.name]}
          owner={value}
        />
      ))}
    </form>
  );
}

/** A program without a scenario runs in the default one. */
function Without() {
  const add = () => {
    const [program] = pathsOf(project.value.files, "program");
    const free = project.value.files["scenario.toml"] === undefined ? "scenario.toml" : "run.toml";
    addFile(free, templateOf(free, program));
  };
  return (
    <div class="without">
      <p>
        A scenario says which robots there are, what their world looks like, how good the radio is, and what
        breaks. This project has none: its program runs with four robots on an empty floor with four
        waypoints.
      </p>
      <button type="button" class="primary" onClick={add}>
        Add a scenario
      </button>
    </div>
  );
}
