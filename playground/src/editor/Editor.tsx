// The project's files: tabs, the editor, and diagnostics.

import { useEffect, useState } from "preact/hooks";
import { checked, diagnostics } from "../project/checking.ts";
import { notKept, project, rename } from "../project/project.ts";
import { CodePane, pane } from "./CodePane.tsx";
import { Explained } from "./explain.tsx";
import { FileTabs } from "./FileTabs.tsx";
import { goTo, reading } from "./jump.ts";
import { Problems } from "./Problems.tsx";
import { type Entry, outline } from "./services.ts";
import "../styles/editor.css";

export function Editor() {
  const { active, name, files } = project.value;
  const read = reading.value;
  const faulty = new Set(
    diagnostics.value.filter(({ severity }) => severity === "error").map(({ file }) => file ?? ""),
  );
  return (
    <div class="editor">
      <div class="row head">
        <input
          class="project-name"
          aria-label="Name of the project"
          value={name}
          maxLength={80}
          onChange={(event) => rename(event.currentTarget.value)}
        />
        {active.endsWith(".starl") && <Outline path={active} />}
        {active.endsWith(".starl") && (
          <button
            type="button"
            onClick={() => pane.current?.format()}
            title="Lay the program out (Ctrl+Shift+F)"
          >
            Format
          </button>
        )}
      </div>
      {notKept.value && (
        <p class="error" role="alert">
          {notKept.value}
        </p>
      )}
      <FileTabs faulty={faulty} />
      <div class="fill">
        {read ? (
          <CodePane key="read" path={read.path} text={read.text} readOnly />
        ) : files[active] !== undefined ? (
          <CodePane key="file" path={active} />
        ) : (
          <p class="muted">There is no file. Add one with +.</p>
        )}
      </div>
      <Problems />
      <Explained />
    </div>
  );
}

/** Goes to what a program declares. */
function Outline({ path }: { path: string }) {
  const [symbols, setSymbols] = useState<Entry[]>([]);
  useEffect(() => {
    let here = true;
    void outline(path).then((found) => here && setSymbols(flat(found ?? [])));
    return () => {
      here = false;
    };
  }, [path, checked.value]);
  if (symbols.length === 0) return null;
  return (
    <select
      class="outline"
      aria-label="Go to"
      value=""
      onChange={(event) => {
        const symbol = symbols[Number(event.currentTarget.value)];
        event.currentTarget.value = "";
        if (symbol) goTo(path, symbol.name_range);
      }}
    >
      <option value="">Go to …</option>
      {symbols.map(({ name, kind }, index) => (
        <option key={`${name}${index}`} value={String(index)}>
          {name} ({kind.replaceAll("_", " ")})
        </option>
      ))}
    </select>
  );
}

const flat = (symbols: Entry[]): Entry[] => symbols.flatMap((symbol) => [symbol, ...flat(symbol.parts)]);
