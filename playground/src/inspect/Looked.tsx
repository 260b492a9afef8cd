// Everything that is known of the chosen robots at the moment shown, beside each other, with what has just changed
// marked.

import { signal, useSignal } from "@preact/signals";
import { colorOf } from "../app/colors.ts";
import { run } from "../app/context.ts";
import { Quick } from "../meddle/Quick.tsx";
import { Changes } from "./changes.ts";
import { type Fact, type Section, sectionsOf } from "./facts.ts";
import { nameOf } from "./names.ts";
import { unfold } from "./unfold.ts";

/** Longer values are folded. */
const LONG = 64;
/** Of a value, so many characters are shown at most. */
const MOST = 20_000;

const folded = signal(new Set(["Parameters", "Clock"]));
const changes = new Changes();
let opened: unknown = null;

export function Looked() {
  const robots = run.robots.value.map((robot) => ({
    id: robot.id,
    robot,
    sections: sectionsOf(robot, nameOf),
  }));
  if (opened !== run.opened.value) changes.clear();
  opened = run.opened.value;
  const at = performance.now();
  changes.update(run.now.value, robots, at);
  const playing = run.playing.value;
  const of = run.fleet.value.length;
  if (robots.length === 0) return <p class="muted">The state of the robot is loading.</p>;
  return (
    <div class="looked">
      <table>
        <thead>
          <tr>
            <th scope="col">
              <span class="visually-hidden">What</span>
            </th>
            {robots.map(({ id, robot }) => (
              <th key={id} scope="col">
                <span class="swatch" style={{ background: colorOf(id, of) }} /> {robot.name}{" "}
                <span class="muted">{robot.model}</span>
                <Quick robot={id} condition={robot.condition} />
              </th>
            ))}
          </tr>
        </thead>
        {titles(robots).map((title) => {
          const isFolded = folded.value.has(title);
          return (
            <tbody key={title}>
              <tr>
                <th colSpan={robots.length + 1} scope="rowgroup" class="section">
                  <button type="button" aria-expanded={!isFolded} onClick={() => toggle(title)}>
                    <span class="fold" aria-hidden="true" /> {title}
                  </button>
                </th>
              </tr>
              {!isFolded &&
                names(robots, title).map((name) => (
                  <tr key={name}>
                    <th scope="row">{name}</th>
                    {robots.map(({ id, sections }) => {
                      const fact = find(sections, title, name);
                      const change = fact && changes.of(id, title, name, playing, at);
                      return <Cell key={id} fact={fact} change={change ?? null} />;
                    })}
                  </tr>
                ))}
            </tbody>
          );
        })}
      </table>
    </div>
  );
}

function Cell({ fact, change }: { fact: Fact | undefined; change: { before: string | null } | null }) {
  if (!fact) return <td class="muted">-</td>;
  const { value, hint, mark } = fact;
  const was = change && (change.before === null ? "new" : `was ${short(change.before)}`);
  return (
    <td class={`${mark ?? ""} ${change ? "changed" : ""}`} title={hint}>
      {value.length > LONG ? <Long value={value} /> : <span class="value">{value}</span>}
      {was && <span class="was"> {was}</span>}
    </td>
  );
}

/** A value that is folded up until a person wants to see all of it. */
function Long({ value }: { value: string }) {
  const open = useSignal(false);
  return (
    <details
      onToggle={(event) => {
        open.value = event.currentTarget.open;
      }}
    >
      <summary>{short(value)}</summary>
      {open.value && <pre>{unfold(value.slice(0, MOST))}</pre>}
    </details>
  );
}

type Shown = { sections: Section[] }[];

/** The sections that at least one robot has something in. */
const titles = (robots: Shown): string[] =>
  (robots[0]?.sections ?? []).map(({ title }) => title).filter((title) => names(robots, title).length > 0);

function names(robots: Shown, title: string): string[] {
  const all = robots.flatMap(
    ({ sections }) => sections.find((section) => section.title === title)?.facts ?? [],
  );
  return [...new Set(all.map(({ name }) => name))];
}

const find = (sections: Section[], title: string, name: string): Fact | undefined =>
  sections.find((section) => section.title === title)?.facts.find((fact) => fact.name === name);

const short = (value: string): string => (value.length > LONG ? `${value.slice(0, LONG - 4)} ...` : value);

function toggle(title: string): void {
  const next = new Set(folded.value);
  if (!next.delete(title)) next.add(title);
  folded.value = next;
}
