// Where the run stops by itself: at an action, at a message, or when an expression over the robots becomes true.

import { signal } from "@preact/signals";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { EngineError } from "../engine/client.ts";
import type { Breakpoint, Diagnostic } from "../engine/types.ts";
import { nameOf } from "../inspect/names.ts";
import { Choice, Text } from "../meddle/inputs.tsx";
import { breakpointWords } from "./words.ts";
import "../styles/breakpoints.css";

const kind = signal("action");
const name = signal("");
const robot = signal("");
const expression = signal("");
const refusal = signal<{ kind: string; text: string; expression: string; diagnostics: Diagnostic[] } | null>(
  null,
);

/** A list of more robots does not help. */
const LISTED = 500;

export function Breakpoints() {
  if (!run.opened.value) return <p class="muted">Open a program to stop it where you want.</p>;
  return (
    <div class="breakpoints">
      <Stopped />
      <List />
      <Form />
    </div>
  );
}

function Stopped() {
  const stopped = run.stopped.value;
  if (!stopped) return null;
  return (
    <p class="stopped-at" role="status">
      Stopped at{" "}
      <button type="button" class="link" onClick={() => run.show({ time: stopped.at })}>
        {seconds(stopped.at, 3)}
      </button>
      {stopped.robot !== null && (
        <>
          {" "}
          at{" "}
          <button type="button" class="link" onClick={() => run.select([stopped.robot ?? 0])}>
            {nameOf(stopped.robot)}
          </button>
        </>
      )}
      : {stopped.text}{" "}
      <button type="button" class="small" onClick={() => run.play()}>
        Go on
      </button>
    </p>
  );
}

function List() {
  const list = run.breakpoints.value;
  if (list.length === 0) return <p class="muted">There is no breakpoint: the run stops only at its end.</p>;
  return (
    <ul class="plain">
      {list.map((breakpoint, index) => {
        const words = breakpointWords(breakpoint, nameOf);
        const here = run.stopped.value?.breakpoint === index;
        return (
          <li key={words} class={here ? "here" : ""}>
            <span>
              {words}
              {here && <strong> (stopped here)</strong>}
            </span>
            <button
              type="button"
              class="small"
              aria-label={`Remove the breakpoint: ${words}`}
              onClick={() => put(list.filter((other) => other !== breakpoint))}
            >
              Remove
            </button>
          </li>
        );
      })}
    </ul>
  );
}

function Form() {
  const add = async (event: SubmitEvent) => {
    event.preventDefault();
    const breakpoint = made();
    if (breakpoint && (await put([...run.breakpoints.value, breakpoint]))) expression.value = "";
  };
  return (
    <form onSubmit={add}>
      <Choice label="Stop at" value={kind}>
        <option value="action">an action</option>
        <option value="message">a message that is delivered</option>
        <option value="when">an expression that becomes true</option>
      </Choice>
      {kind.value === "when" ? <Expression /> : <Named />}
      <button type="submit" disabled={made() === null}>
        Add
      </button>
      {refusal.value?.kind === kind.value && <Refusal />}
    </form>
  );
}

function Named() {
  const isAction = kind.value === "action";
  const actions = [
    ...new Set(run.robots.value.flatMap((robot) => robot.actions.map((action) => action.name))),
  ];
  return (
    <>
      <Text
        label={isAction ? "Name of the action" : "Type of the message; empty for any"}
        value={name}
        placeholder={isAction ? "pick" : "Reached"}
      />
      {isAction && actions.length > 0 && (
        <div class="acts">
          {actions.map((action) => (
            <button
              key={action}
              type="button"
              class="small"
              onClick={() => {
                name.value = action;
              }}
            >
              {action}
            </button>
          ))}
        </div>
      )}
      <Choice label="Robot" value={robot}>
        <option value="">any robot</option>
        {run.fleet.value.slice(0, LISTED).map(({ id, name }) => (
          <option key={id} value={String(id)}>
            {name}
          </option>
        ))}
      </Choice>
    </>
  );
}

function Expression() {
  return (
    <label class="field">
      <span>Expression, as in a property</span>
      <textarea
        class="mono"
        rows={2}
        spellcheck={false}
        placeholder="exists r: r.currentIndex > 1"
        value={expression.value}
        aria-invalid={refusal.value?.expression === expression.value && expression.value !== ""}
        aria-describedby={refusal.value ? "breakpoint-refusal" : undefined}
        onInput={(event) => {
          expression.value = event.currentTarget.value;
          refusal.value = null;
        }}
      />
    </label>
  );
}

/** The error, under its place. */
function Refusal() {
  if (!refusal.value) return null;
  const { text, expression, diagnostics } = refusal.value;
  return (
    <div id="breakpoint-refusal" class="refused" role="alert">
      {diagnostics.length === 0 && <p>{text}</p>}
      {diagnostics.map(({ line, column, length, message, help }) => (
        <div key={`${line}:${column}:${message}`}>
          {expression && (
            <pre>
              {expression.split("\n")[line - 1]}
              {"\n"}
              {" ".repeat(Math.max(0, column - 1))}
              {"^".repeat(Math.max(1, length))}
            </pre>
          )}
          <p>
            {message} {help && <span class="muted">{help}</span>}
          </p>
        </div>
      ))}
    </div>
  );
}

/** The breakpoint that the form describes; null if something is missing. */
function made(): Breakpoint | null {
  const which = robot.value === "" ? null : Number(robot.value);
  if (kind.value === "when") {
    return expression.value.trim() === "" ? null : { when: { expression: expression.value } };
  }
  const called = name.value.trim();
  if (kind.value === "message") return { message: { name: called || null, robot: which } };
  return called === "" ? null : { action: { name: called, robot: which } };
}

/** Replaces the breakpoints. Returns whether they were accepted. */
async function put(list: Breakpoint[]): Promise<boolean> {
  refusal.value = null;
  try {
    await run.setBreakpoints(list);
    return true;
  } catch (error) {
    const diagnostics = error instanceof EngineError ? error.diagnostics : [];
    const text = error instanceof Error ? error.message : String(error);
    const asked = kind.value === "when" ? expression.value : "";
    refusal.value = { kind: kind.value, text, expression: asked, diagnostics };
    return false;
  }
}
