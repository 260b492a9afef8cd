// Whether the run is as it should be: each property with its verdict, the violations, the outcome and the digest.

import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import type { Report } from "../engine/types.ts";
import { CausalPast } from "./CausalPast.tsx";
import { nameOf } from "./names.ts";
import { SaveTrace } from "./SaveTrace.tsx";
import { VirtualList } from "./VirtualList.tsx";
import { chosenViolation, showViolation, violations } from "./violations.ts";
import "../styles/properties.css";

const ROW = 44;
const MOST_ROWS = 5;

type Property = Report["properties"][number];

const VERDICTS: Record<Property["verdict"], { mark: string; text: string }> = {
  violated: { mark: "M3 3l10 10M13 3L3 13", text: "violated" },
  open: { mark: "M8 3v6M8 12v1", text: "not decided yet" },
  holds: { mark: "M2 8l4 5 8-10", text: "holds" },
  unused: { mark: "M3 8h10", text: "not applicable" },
};
const ORDER: Property["verdict"][] = ["violated", "open", "holds"];

export function Properties() {
  const report = run.report.value;
  if (!run.opened.value || !report) return <p class="muted">Open a program to see which properties hold.</p>;
  const unused = report.properties.filter(({ verdict }) => verdict === "unused");
  return (
    <div class="properties">
      <Summary report={report} />
      <Violations />
      <CausalPast />
      {ORDER.map((verdict) => (
        <List
          key={verdict}
          properties={report.properties.filter((property) => property.verdict === verdict)}
        />
      ))}
      {unused.length > 0 && (
        <details>
          <summary>
            {unused.length} properties are not applicable: the program does not use what they are about
          </summary>
          <List properties={unused} />
        </details>
      )}
      {!run.live.value && (
        <p class="muted">
          This run is a recording: it holds the violations that were found, and no verdicts.{" "}
          <code>starl verify</code> judges it anew.
        </p>
      )}
    </div>
  );
}

function Summary({ report }: { report: Report }) {
  const fresh = useSignal(Number.NaN);
  const now = run.now.value;
  const [playing, live] = [run.playing.value, run.live.value];
  useEffect(() => {
    if (playing || !live || fresh.value === now) return;
    // The digest of a moment costs time, so it is asked for when the moment stays.
    const timer = setTimeout(async () => {
      if (await run.refreshReport()) fresh.value = now;
    }, 250);
    return () => clearTimeout(timer);
  }, [playing, live, now]);
  const { progress, messages } = report;
  const upToDate = !live || (!playing && report.now === now);
  return (
    <>
      <dl class="facts">
        <dt>Outcome</dt>
        <dd>{report.outcome ? OUTCOMES[report.outcome] : "the run goes on"}</dd>
        <dt>Robots</dt>
        <dd>
          {progress.up} of {progress.robots} up
          {live && `, ${progress.finished} finished, ${progress.failed} failed`}
        </dd>
        <dt>Messages</dt>
        <dd>
          {messages.sent} sent, {messages.delivered} delivered, {messages.lost + messages.dropped} lost
          {messages.retransmitted > 0 && `, ${messages.retransmitted} sent again`}
        </dd>
        <dt>Collisions</dt>
        <dd>{report.collisions}</dd>
        <dt title="A hash of all that has happened: the same program, scenario and seed give the same digest everywhere">
          Digest
        </dt>
        <dd class="mono">{upToDate ? report.digest || "not recorded" : "shown when paused"}</dd>
      </dl>
      {live && <SaveTrace />}
      {report.failures.length > 0 && (
        <section aria-label="Failures">
          <h2>Programs that failed</h2>
          <ul class="plain">
            {report.failures.slice(0, 50).map(({ at, robot, text }) => (
              <li key={`${robot}-${at}`}>
                <button type="button" class="link" onClick={() => run.show({ time: at })}>
                  {seconds(at, 3)}
                </button>{" "}
                <strong>{nameOf(robot)}</strong>: {text}
              </li>
            ))}
          </ul>
        </section>
      )}
    </>
  );
}

const OUTCOMES = {
  reached: "goal reached",
  violated: "a property is violated",
  timed_out: "time is over",
  failed: "a program failed",
};

function Violations() {
  const list = violations.value;
  if (list.length === 0) return null;
  return (
    <section aria-label="Violations">
      <h2>
        {list.length} {list.length === 1 ? "violation" : "violations"}
      </h2>
      <p class="muted">Choose one to go to its moment and to see its possible causes.</p>
      <div style={{ height: `${Math.min(list.length, MOST_ROWS) * ROW + 2}px`, display: "grid" }}>
        <VirtualList
          label="Violations"
          count={list.length}
          rowHeight={ROW}
          choose={(index) => {
            const violation = list[index];
            if (violation) void showViolation(violation);
          }}
          selected={(index) => list[index] === chosenViolation.value}
          rowClass={(index) => ((list[index]?.at ?? 0) > run.now.value ? "later" : "")}
          row={(index) => {
            const violation = list[index];
            if (!violation) return null;
            const { property, at, robots, text } = violation;
            return (
              <span class="grow" title={text}>
                <span class="time-cell">{seconds(at, 3)}</span> <strong>{property}</strong>{" "}
                {robots.slice(0, 4).map(nameOf).join(", ")}
                <br />
                {text}
              </span>
            );
          }}
        />
      </div>
    </section>
  );
}

function List({ properties }: { properties: Property[] }) {
  if (properties.length === 0) return null;
  return (
    <ul class="plain verdicts">
      {properties.map(({ property, verdict, violations, excused }) => (
        <li key={property} class={verdict}>
          <svg width="16" height="16" viewBox="0 0 16 16" aria-hidden="true">
            <path d={VERDICTS[verdict].mark} fill="none" stroke="currentColor" stroke-width="2.2" />
          </svg>
          <span>
            <strong>{property}</strong> {VERDICTS[verdict].text}
            {violations > 0 && ` ${violations} ${violations === 1 ? "time" : "times"}`}
            {excused.map(({ reason, count }) => (
              <span key={reason} class="muted">
                {" "}
                ({count} excused: {reason})
              </span>
            ))}
          </span>
        </li>
      ))}
    </ul>
  );
}
