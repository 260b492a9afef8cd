// Everything that happened, one line an event. The line of the moment shown is kept in view; a click jumps to the
// moment of a line.

import { signal, useComputed, useSignal, useSignalEffect } from "@preact/signals";
import { useRef } from "preact/hooks";
import { run } from "../app/context.ts";
import { seconds } from "../app/format.ts";
import type { Event } from "../run/events.ts";
import { describe } from "../timeline/lanes.ts";
import { Filtered } from "./filtered.ts";
import { KINDS, kindNameOf, kindOf } from "./kinds.ts";
import { nameOf } from "./names.ts";
import { VirtualList } from "./VirtualList.tsx";
import "../styles/log.css";

/** Looking through a long run takes the page so much of a frame, ms. */
const SLICE = 6;

const kinds = signal(new Set(["Violations", "Faults", "Programs", "Log lines", "Primitives"]));
const text = signal("");
const onlyChosen = signal(false);
const follow = signal(true);

export function Log() {
  const scanned = useSignal(0);
  const waiting = useRef(0);
  const filtered = useComputed(() => {
    void run.opened.value;
    return new Filtered(run.events, filter());
  });
  useSignalEffect(() => {
    void run.grown.value;
    const scan = () => {
      waiting.current = 0;
      if (!filtered.value.scan(SLICE)) waiting.current = requestAnimationFrame(scan);
      scanned.value++;
    };
    cancelAnimationFrame(waiting.current);
    scan();
    return () => cancelAnimationFrame(waiting.current);
  });
  void scanned.value;
  const { list } = filtered.value;
  const shown = filtered.value.before(run.position.value);
  return (
    <div class="log">
      <Filters />
      <VirtualList
        label="Events"
        count={list.length}
        rowHeight={24}
        reveal={follow.value ? shown - 1 : null}
        rowClass={(index) => (index >= shown ? "later" : index === shown - 1 ? "at-now" : "")}
        choose={(index) => {
          const event = list[index];
          if (event) void run.show(event);
        }}
        onScrolled={() => {
          follow.value = false;
        }}
        row={(index) => {
          const event = list[index];
          return event && <Line event={event} />;
        }}
      />
      <p class="muted foot">
        {waiting.current ? "Searching: " : ""}
        {list.length.toLocaleString("en")} of {run.events.list.length.toLocaleString("en")} events
        {run.events.forgotten > 0 &&
          `; ${run.events.forgotten.toLocaleString("en")} of the oldest are forgotten`}
        {run.events.isWindow && "; messages and actions near the moment shown only"}
      </p>
    </div>
  );
}

function Line({ event }: { event: Event }) {
  const text = describe(event, nameOf);
  return (
    <>
      <span class="time-cell muted">{seconds(event.time, 3)}</span>
      <span class={`grow kind ${kindOf(event.topic)}`} title={text}>
        {text}
      </span>
    </>
  );
}

function Filters() {
  return (
    <div class="tools">
      <input
        type="search"
        placeholder="Search the events"
        aria-label="Search the events"
        value={text.value}
        onInput={(event) => {
          text.value = event.currentTarget.value;
        }}
      />
      <details class="menu">
        <summary>Kinds</summary>
        <fieldset>
          <legend class="visually-hidden">Kinds of events</legend>
          {KINDS.map(({ name }) => (
            <label key={name}>
              <input type="checkbox" checked={kinds.value.has(name)} onChange={() => toggle(name)} /> {name}
            </label>
          ))}
        </fieldset>
      </details>
      <Check label="Chosen robots only" value={onlyChosen} />
      <Check label="Follow" value={follow} />
    </div>
  );
}

function Check({ label, value }: { label: string; value: { value: boolean } }) {
  return (
    <label>
      <input
        type="checkbox"
        checked={value.value}
        onChange={(event) => {
          value.value = event.currentTarget.checked;
        }}
      />{" "}
      {label}
    </label>
  );
}

/** The filter as it is set now. */
function filter(): (event: Event) => boolean {
  const [wanted, words] = [kinds.value, text.value.trim().toLowerCase()];
  const robots = onlyChosen.value ? new Set(run.selected.value) : null;
  const topics = new Map<string, boolean>();
  return (event) => {
    let passes = topics.get(event.topic);
    if (passes === undefined) {
      passes = wanted.has(kindNameOf(event.topic));
      topics.set(event.topic, passes);
    }
    if (!passes) return false;
    if (robots && !robots.has(event.message.robot ?? -1)) return false;
    return !words || `${kindOf(event.topic)} ${describe(event, nameOf)}`.toLowerCase().includes(words);
  };
}

function toggle(name: string): void {
  const next = new Set(kinds.value);
  if (!next.delete(name)) next.add(name);
  kinds.value = next;
}
