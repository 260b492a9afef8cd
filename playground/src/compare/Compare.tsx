// Two runs side by side, with the first difference marked.

import { signal } from "@preact/signals";
import { colorOf } from "../app/colors.ts";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import { Text } from "../meddle/inputs.tsx";
import type { Chart } from "../plots/chart.ts";
import { drawnRobots } from "../plots/charts.ts";
import { Picture } from "../plots/Picture.tsx";
import { Tracks } from "../plots/tracks.ts";
import { describe } from "../timeline/lanes.ts";
import { around, type Difference } from "./difference.ts";
import {
  compareSeed,
  compareShown,
  difference,
  keep,
  kept,
  nameIn,
  openAt,
  other,
  problem,
  type Recording,
  stop,
  underWay,
} from "./recordings.ts";
import "../styles/compare.css";

/** Records that are shown before the difference, and from it on. */
const BEFORE = 4;
const AFTER = 12;

const seed = signal("2");

export function Compare() {
  if (!run.opened.value) return <p class="muted">Open a program to compare two of its runs.</p>;
  const [first, second] = [kept.value, other.value];
  const seeded = (first?.source ?? run.source.value)?.kind === "files";
  return (
    <div class="compare">
      <p class="muted">
        Keep a run, change the program or the scenario, run again, and see where the two runs part. Or compare
        with another seed.
      </p>
      <div class="acts">
        <button type="button" disabled={run.known.value === 0} onClick={keep}>
          Keep this run
        </button>
        <button type="button" disabled={!first} onClick={compareShown}>
          Compare with the run shown
        </button>
      </div>
      {seeded && (
        <div class="acts">
          <Text label="Another seed" value={seed} />
          <button
            type="button"
            disabled={underWay.value !== null || run.known.value === 0 || !/^\d+$/.test(seed.value.trim())}
            onClick={() => compareSeed(seed.value.trim())}
          >
            Compare with this seed
          </button>
        </div>
      )}
      {underWay.value !== null && (
        <p role="status">
          The other run is at {seconds(underWay.value)} of {seconds(first?.until ?? 0)}.{" "}
          <button type="button" class="small" onClick={stop}>
            Stop
          </button>
        </p>
      )}
      {problem.value && <p role="alert">{problem.value}</p>}
      {first && (
        <p>
          Kept: <strong>{first.name}</strong>, known to {seconds(first.until)}.
        </p>
      )}
      {first && second && <Result first={first} second={second} found={difference.value} />}
    </div>
  );
}

function Result({ first, second, found }: { first: Recording; second: Recording; found: Difference | null }) {
  const both = Math.min(first.until, second.until);
  if (!found) {
    return (
      <p role="status">
        No record differs up to {seconds(both)}: the runs <strong>{first.name}</strong> and{" "}
        <strong>{second.name}</strong> are the same.
      </p>
    );
  }
  return (
    <>
      <h2>The first difference is at {seconds(found.time, 3)}</h2>
      <div class="sides">
        <Side recording={first} index={found.index} time={found.time} />
        <Side recording={second} index={found.index} time={found.time} />
      </div>
      <h2>Paths of both</h2>
      <p class="muted">The kept run is drawn thin and dashed.</p>
      <Picture chart={pathsOf(first, second)} />
    </>
  );
}

function Side({ recording, index, time }: { recording: Recording; index: number; time: number }) {
  const name = nameIn(recording);
  const differs = recording.list.find((event) => event.index >= index)?.index;
  return (
    <section aria-label={recording.name}>
      <h3>{recording.name}</h3>
      <button type="button" class="small" onClick={() => openAt(recording, time)}>
        Show this moment
      </button>
      <ol>
        {around(recording.list, index, BEFORE, AFTER).map((event) => (
          <li
            key={event.index}
            class={event.index === differs ? "differs" : event.index < index ? "same" : ""}
          >
            <span class="muted">{seconds(event.time, 3)}</span>{" "}
            {event.index === differs && <strong>First difference: </strong>}
            <span class="what" title={describe(event, name)}>
              {describe(event, name)}
            </span>
          </li>
        ))}
        {differs === undefined && <li class="differs">This run is over.</li>}
      </ol>
    </section>
  );
}

function pathsOf(first: Recording, second: Recording): Chart {
  const robots = drawnRobots();
  const lines = [first, second].flatMap((recording) => {
    const tracks = new Tracks({ frames: recording.frames, generation: 0 }, robots);
    tracks.update();
    return robots.map((robot, index) => ({
      name: recording === first ? `${nameIn(recording)(robot)} (kept)` : nameIn(recording)(robot),
      color: colorOf(robot, recording.fleet.length),
      kept: recording === first,
      x: tracks.robots[index]?.x ?? [],
      y: tracks.robots[index]?.y ?? [],
    }));
  });
  return { title: "Paths", xLabel: "x, m", yLabel: "y, m", square: true, lines };
}
