// Plots of the run, of several runs over each other if some were kept, and their export.

import { signal, useSignal, useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
import { run } from "../app/context.ts";
import { download } from "../app/download.ts";
import { theme } from "../app/theme.ts";
import { type Chart, csvOf } from "./chart.ts";
import { chartOf, drawnRobots, type Kind, keepRun, keptRuns, sharedNames } from "./charts.ts";
import { Picture } from "./Picture.tsx";
import { PAPER, pngOf, svgOf } from "./svg.ts";
import { TimePlot } from "./TimePlot.tsx";
import "../styles/plots.css";

/** The interval at which the plot of a playing run is redrawn, ms. */
const EVERY = 250;

const KINDS: [Kind, string][] = [
  ["path", "paths: y against x"],
  ["x", "x over time"],
  ["y", "y over time"],
  ["z", "z over time"],
  ["speed", "speed over time"],
  ["messages", "messages a second"],
  ["shared", "shared variable over time"],
];

const kind = signal<Kind>("path");
const variable = signal("");

export function Plots() {
  const chart = useSignal<Chart | null>(null);
  const drawn = useRef(0);
  const problem = useSignal("");
  useSignalEffect(() => {
    void [run.grown.value, run.fleet.value, run.selected.value, theme.value, keptRuns.value];
    const [what, which] = [kind.value, variable.value];
    const make = () => {
      drawn.current = performance.now();
      chart.value = run.opened.peek() ? chartOf(what, which || (sharedNames()[0] ?? "")) : null;
    };
    const wait = run.playing.value ? drawn.current + EVERY - performance.now() : 0;
    const timer = setTimeout(make, Math.max(0, wait));
    return () => clearTimeout(timer);
  });
  if (!run.opened.value) return <p class="muted">Open a program to see plots of its run.</p>;
  const shown = chart.value;
  const empty = !shown?.lines.some((line) => line.x.length > 1);
  return (
    <div class="plots">
      <Choice />
      {shown && !empty && (shown.square ? <Picture chart={shown} /> : <TimePlot chart={shown} />)}
      {empty && <p class="muted">{why(kind.value)}</p>}
      <p class="muted">
        {kind.value !== "messages" &&
          run.selected.value.length === 0 &&
          run.fleet.value.length > drawnRobots().length &&
          `The first ${drawnRobots().length} robots are drawn; choose others under Robots. `}
        {kind.value === "shared" &&
          shown?.names?.some((name) => /^value \d+$/.test(name)) &&
          "Values that are not known are numbered as they first appear: robots with the same number hold the same value."}
      </p>
      <div class="tools">
        <Save label="SVG" chart={shown} problem={problem} />
        <Save label="PNG" chart={shown} problem={problem} />
        <Save label="CSV" chart={shown} problem={problem} />
      </div>
      {problem.value && <p role="alert">{problem.value}</p>}
      <Kept />
    </div>
  );
}

const why = (kind: Kind): string =>
  kind === "shared"
    ? "No shared variable was written so far."
    : "There is nothing to draw yet: play the run.";

function Choice() {
  void run.grown.value;
  const names = kind.value === "shared" ? sharedNames() : [];
  return (
    <div class="tools">
      <label class="field">
        <span>Plot</span>
        <select
          value={kind.value}
          onChange={(event) => {
            kind.value = event.currentTarget.value as Kind;
          }}
        >
          {KINDS.map(([name, label]) => (
            <option key={name} value={name}>
              {label}
            </option>
          ))}
        </select>
      </label>
      {names.length > 0 && (
        <label class="field">
          <span>Variable</span>
          <select
            value={variable.value || names[0]}
            onChange={(event) => {
              variable.value = event.currentTarget.value;
            }}
          >
            {names.map((name) => (
              <option key={name}>{name}</option>
            ))}
          </select>
        </label>
      )}
    </div>
  );
}

function Kept() {
  const kept = keptRuns.value;
  return (
    <section aria-label="Runs that are kept">
      <div class="tools">
        <button type="button" disabled={run.history.frames.length === 0} onClick={keepRun}>
          Keep this run in the plots
        </button>
        {kept.length > 0 && (
          <span class="muted">Kept runs are drawn thin and dashed, with their number.</span>
        )}
      </div>
      <ul class="plain">
        {kept.map((one) => (
          <li key={one.name}>
            {one.name}{" "}
            <button
              type="button"
              class="small"
              onClick={() => {
                keptRuns.value = keptRuns.value.filter((other) => other !== one);
              }}
            >
              Remove
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}

function Save({
  label,
  chart,
  problem,
}: {
  label: "SVG" | "PNG" | "CSV";
  chart: Chart | null;
  problem: { value: string };
}) {
  const save = async () => {
    if (!chart) return;
    problem.value = "";
    const name = `${run.opened.value?.title ?? "run"} ${chart.title}`
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, "-");
    try {
      if (label === "CSV") download(`${name}.csv`, "text/csv", csvOf(chart));
      else if (label === "SVG") download(`${name}.svg`, "image/svg+xml", svgOf(chart, PAPER));
      else download(`${name}.png`, "image/png", await pngOf(svgOf(chart, PAPER)));
    } catch (error) {
      problem.value = `The file could not be made: ${(error as Error).message}`;
    }
  };
  return (
    <button type="button" class="small" disabled={!chart} onClick={save}>
      Save as {label}
    </button>
  );
}
