// The first lesson: about ten minutes, from a program that runs to a program of one's own. Each step is done when the
// simulator says so.

import type { JSX } from "preact";
import type { Diagnostic, Outcome, Report } from "../engine/types.ts";
import { isTable, type Table, tablesOf } from "../scenario/table.ts";
import * as programs from "./programs.ts";

/** The view of a step when it is judged. */
export interface Seen {
  /** The project's files. */
  files: Record<string, string>;
  /** The content of its scenario; null while it is not valid TOML. */
  scenario: Table | null;
  /** Of these files; null while they are being checked. */
  diagnostics: Diagnostic[] | null;
  /** The run of these files; null if another one is shown. */
  run: { now: number; over: boolean; outcome: Outcome | null; report: Report | null; down: boolean } | null;
}

export interface Step {
  title: string;
  text: JSX.Element;
  isDone: (seen: Seen) => boolean;
  /** Shown once it is done. */
  after: JSX.Element;
  /** The files as they are when it is done by the book. */
  solution: Record<string, string> | null;
  /** The files that a person begins with, where the step brings new ones. */
  given?: Record<string, string>;
}

const hasErrors = ({ diagnostics }: Seen) =>
  diagnostics?.some(({ severity }) => severity === "error") ?? false;
const isClean = (seen: Seen) => seen.diagnostics !== null && !hasErrors(seen);
const isOver = ({ run }: Seen) => run?.over ?? false;
const verdict = ({ run }: Seen, name: string) =>
  run?.report?.properties.find(({ property }) => property === name)?.verdict;
const lossOf = ({ scenario }: Seen) => (isTable(scenario?.network) ? scenario.network.loss : undefined);
const wayPoints = ({ scenario }: Seen) =>
  isTable(scenario?.world) ? tablesOf(scenario.world.way_point).length : 0;

const both = (program: string, scenario = programs.SCENARIO) => ({
  "hunt.starl": program,
  "hunt.toml": scenario,
});

export const STEPS: Step[] = [
  {
    title: "Run it",
    text: (
      <>
        <p>
          Below is a program. Every robot runs it. <code>motion</code> knows how to drive around obstacles;{" "}
          <code>go</code> is an action: when its guard, <code>pre</code>, holds, its effect, <code>eff</code>,
          happens.
        </p>
        <p>
          Press <b>Run</b> at the top, and watch for ten seconds.
        </p>
      </>
    ),
    given: both(programs.FIRST),
    solution: both(programs.FIRST),
    isDone: ({ run }) => (run?.now ?? 0) >= 10,
    after: <p>All of them drive to the first place, A. One arrives; the others block each other.</p>,
  },
  {
    title: "Make a mistake",
    text: (
      <>
        <p>
          The guard tests whether there is a first place. Remove that test: delete{" "}
          <code>and some place = way_points().first()</code>, and put <code>way_points().first()</code> where{" "}
          <code>place</code> stood in the last line.
        </p>
        <p>The mistake is marked as you type. Click its number, E0221, to read about it.</p>
      </>
    ),
    solution: both(programs.WRONG),
    isDone: ({ diagnostics }) => diagnostics?.some(({ code }) => code === "E0221") ?? false,
    after: <p>A list may be empty, so its first element may be none, and no robot can drive to none.</p>,
  },
  {
    title: "Fix it",
    text: <p>Undo your change (Ctrl+Z), or type it again, until there are no problems.</p>,
    solution: both(programs.FIRST),
    isDone: isClean,
    after: <p>A program with errors never runs: the run that is shown stays as it is.</p>,
  },
  {
    title: "Write an action",
    text: (
      <>
        <p>
          Now they search everywhere: this program remembers its searches, and drives to the nearest place
          that is still open. But it never ends. Add an action at its end:
        </p>
        <pre>{programs.FINISH.trim()}</pre>
        <p>
          Run it. At <b>Speed</b> you can choose "as fast as it goes".
        </p>
      </>
    ),
    given: both(programs.EVERYWHERE),
    solution: both(programs.FINISHING),
    isDone: ({ run }) => (run?.report?.progress.finished ?? 0) > 0,
    after: (
      <p>
        Robots that have searched everywhere finish. It takes long, because each of them searches everywhere.
      </p>
    ),
  },
  {
    title: "Write a property",
    text: (
      <>
        <p>
          Four robots should share the work. Declare this at the end of the program. No robot can check it,
          because a robot does not see the variables of others. The simulator checks it in every step:
        </p>
        <pre>{programs.ONCE.trim()}</pre>
        <p>Run it.</p>
      </>
    ),
    solution: both(programs.PROMISING),
    isDone: (seen) => verdict(seen, "Hunt.once") === "violated",
    after: (
      <p>
        The property is violated: two robots have searched the same place. <b>Properties</b>, on the right,
        shows which and when. How can a robot know what the others have found?
      </p>
    ),
  },
  {
    title: "Make them a team",
    text: (
      <>
        <p>
          They tell each other. Declare a message above <code>motion</code>, and a radio below it:
        </p>
        <pre>{`${programs.MESSAGE.trim()}\n\nradio = Broadcast()`}</pre>
        <p>
          In <code>arrive</code>, add <code>radio.broadcast(Found(target));</code> before{" "}
          <code>loc = choose</code>. And declare what a robot does when it receives this:
        </p>
        <pre>{programs.HANDLER.trim()}</pre>
        <p>Run it to the end.</p>
      </>
    ),
    solution: both(programs.TEAM),
    isDone: (seen) =>
      isOver(seen) && seen.run?.outcome === "reached" && verdict(seen, "Hunt.once") === "holds",
    after: <p>The goal is reached in half a minute, and the property holds.</p>,
  },
  {
    title: "Make the radio bad",
    text: (
      <p>
        Does it still work if three of ten messages are lost? Under <b>Scenario</b>, open <b>Network</b>, and
        write 30 % as <b>Loss</b>. The text beside the form changes with it. Run it to the end.
      </p>
    ),
    solution: both(programs.TEAM, programs.LOSSY),
    isDone: (seen) =>
      /^(0?\.30*|30(\.0*)?\s*%)$/.test(String(lossOf(seen) ?? "")) &&
      isOver(seen) &&
      (seen.run?.report?.messages.lost ?? 0) > 0,
    after: <p>Broadcast sends unacknowledged messages again. Messages, on the right, shows the lost ones.</p>,
  },
  {
    title: "Change the world",
    text: (
      <p>
        On the map under <b>Scenario</b>, choose <b>Waypoint</b> and click the position of a fifth place. You
        can drag it with <b>Move</b>. Run it to the end.
      </p>
    ),
    solution: both(programs.TEAM, programs.FIVE),
    isDone: (seen) => wayPoints(seen) >= 5 && isOver(seen),
    after: <p>The program did not know the fifth place: it reads the waypoints when it starts.</p>,
  },
  {
    title: "Break it",
    text: (
      <p>
        Robots break down. Run the program again, pause it after about ten seconds, click a robot, and crash
        it under <b>Steer</b>, on the right. Or add a fault to the scenario. Then continue the run.
      </p>
    ),
    solution: both(programs.TEAM, programs.CRASH),
    isDone: ({ run }) => run?.down ?? false,
    after: <p>Do the others finish? They search the places that the lost robot has not reported.</p>,
  },
  {
    title: "Your own program",
    text: (
      <>
        <p>
          Begin with an empty file: four robots, four places, the same world. Write a program in which all
          robots finish. For example: they drive to the first place; the robot that arrives tells the others,
          and all are done.
        </p>
        <p>This lesson ends when one of your runs reaches its goal.</p>
      </>
    ),
    given: { "mine.starl": "program Mine\n" },
    solution: { "mine.starl": programs.OWN },
    isDone: (seen) =>
      isOver(seen) &&
      seen.run?.outcome === "reached" &&
      !Object.values(seen.files).some((text) => /^program Hunt\b/m.test(text)),
    after: (
      <p>
        You have written a distributed program. It is kept under Examples, at Your programs. Share sends it to
        others;
        <b> New seed</b> shows whether it works every time.
      </p>
    ),
  },
];
