// Makes the charts from what is known of the run that is shown and of those that were kept.

import { signal } from "@preact/signals";
import { colorOf } from "../app/colors.ts";
import { run } from "../app/context.ts";
import { nameOf } from "../inspect/names.ts";
import type { Chart, Line } from "./chart.ts";
import { Rates } from "./rates.ts";
import { SharedVariables, type Step, scaleOf } from "./shared.ts";
import { type Quantity, Tracks } from "./tracks.ts";

export type Kind = Quantity | "path" | "messages" | "shared";

/** With no robot chosen, so many are drawn. */
const MOST_ROBOTS = 12;

/** A run that was kept to be drawn under the one that is shown. */
export interface KeptRun {
  /** The marks of its lines. */
  number: number;
  name: string;
  frames: typeof run.history.frames;
  messages: { sent: number[]; delivered: number[]; lost: number[] };
  shared: Map<string, Step[]>;
}

export const keptRuns = signal<KeptRun[]>([]);

const rates = new Rates();
const ratesNow = () => run.rates.value ?? rates.update(run.events);
const sharedVariables = new SharedVariables();
let tracks: Tracks | null = null;

/** Keeps the run as it is known now. */
export function keepRun(): void {
  const { sent, delivered, lost } = ratesNow();
  const shared = new Map(
    [...sharedVariables.update(run.events, run.values).steps].map(([name, steps]) => [name, [...steps]]),
  );
  const opened = run.opened.value;
  const number = (keptRuns.value.at(-1)?.number ?? 0) + 1;
  const name = `${number}: ${opened?.title ?? "run"}, seed ${opened?.seed ?? ""}`;
  keptRuns.value = [
    ...keptRuns.value,
    {
      number,
      name,
      frames: [...run.history.frames],
      messages: { sent: [...sent], delivered: [...delivered], lost: [...lost] },
      shared,
    },
  ];
}

/** The robots that are drawn. */
export function drawnRobots(): number[] {
  const chosen = run.selected.value;
  return chosen.length > 0 ? chosen : run.fleet.value.slice(0, MOST_ROBOTS).map(({ id }) => id);
}

/** The names of the shared variables that are known. */
export const sharedNames = (): string[] =>
  [...sharedVariables.update(run.events, run.values).steps.keys()].sort();

export function chartOf(kind: Kind, variable: string): Chart {
  const robots = drawnRobots();
  switch (kind) {
    case "messages":
      return messagesChart();
    case "shared":
      return sharedChart(variable, robots);
    case "path":
      return {
        title: "Paths",
        xLabel: "x, m",
        yLabel: "y, m",
        square: true,
        lines: robotLines(robots, (tracks, index) => [
          tracks.robots[index]?.x ?? [],
          tracks.robots[index]?.y ?? [],
        ]),
      };
    default:
      return {
        title: kind === "speed" ? "Speed" : kind,
        xLabel: "time, s",
        yLabel: kind === "speed" ? "speed, m/s" : `${kind}, m`,
        square: false,
        lines: robotLines(robots, (tracks, index) => [tracks.times, tracks.robots[index]?.[kind] ?? []]),
      };
  }
}

function robotLines(
  robots: number[],
  values: (tracks: Tracks, index: number) => [number[], number[]],
): Line[] {
  if (!tracks || tracks.chosen.join() !== robots.join()) tracks = new Tracks(run.history, [...robots]);
  tracks.update();
  const of = run.fleet.value.length;
  const line = (from: Tracks, index: number, robot: number, kept: number | null): Line => {
    const [x, y] = values(from, index);
    const name = kept === null ? nameOf(robot) : `${nameOf(robot)} (${kept})`;
    return { name, color: colorOf(robot, of), kept: kept !== null, x, y };
  };
  const shown = tracks;
  return [
    ...keptRuns.value.flatMap((kept) => {
      const old = new Tracks({ frames: kept.frames, generation: 0 }, robots);
      old.update();
      return robots.map((robot, index) => line(old, index, robot, kept.number));
    }),
    ...robots.map((robot, index) => line(shown, index, robot, null)),
  ];
}

function messagesChart(): Chart {
  const kinds = { sent: "#0072b2", delivered: "#009e73", lost: "#d55e00" } as const;
  const names = Object.keys(kinds) as (keyof typeof kinds)[];
  const lines = (counts: KeptRun["messages"], kept: number | null): Line[] =>
    names.map((name) => ({
      name: kept === null ? name : `${name} (${kept})`,
      color: kinds[name],
      kept: kept !== null,
      steps: true,
      x: counts[name].map((_, second) => second),
      y: counts[name],
    }));
  return {
    title: "Messages",
    xLabel: "time, s",
    yLabel: "messages a second",
    square: false,
    lines: [
      ...keptRuns.value.flatMap((kept) => lines(kept.messages, kept.number)),
      ...lines(ratesNow(), null),
    ],
  };
}

function sharedChart(variable: string, robots: number[]): Chart {
  const of = run.fleet.value.length;
  const known = [
    ...keptRuns.value.map(({ shared, number }) => ({ steps: shared.get(variable) ?? [], number })),
    { steps: sharedVariables.update(run.events, run.values).steps.get(variable) ?? [], number: null },
  ];
  const scale = scaleOf(known.flatMap(({ steps }) => steps.map(({ value }) => value)));
  const lines = known.flatMap(({ steps, number }) =>
    robots.map((robot): Line => {
      const own = steps.filter((step) => step.robot === robot);
      return {
        name: number === null ? nameOf(robot) : `${nameOf(robot)} (${number})`,
        color: colorOf(robot, of),
        kept: number !== null,
        steps: true,
        x: own.map(({ time }) => time),
        y: own.map(({ value }) => scale.at(value)),
      };
    }),
  );
  return {
    title: `Shared variable ${variable}`,
    xLabel: "time, s",
    yLabel: variable,
    square: false,
    names: scale.names,
    lines: lines.filter((line) => line.x.length > 0),
  };
}
