// The page as a whole: what is written on the left, the world in the middle, what is known of the run on the right,
// time below.

import { DropPlace } from "../files/OpenFiles.tsx";
import { Transport } from "../timeline/Transport.tsx";
import { WorldView } from "../world/WorldView.tsx";
import { Bench } from "./Bench.tsx";
import { run, start } from "./context.ts";
import { Divider } from "./Divider.tsx";
import { Header } from "./Header.tsx";
import { lazy } from "./lazy.tsx";
import { loadTimeline } from "./loads.ts";
import { Problem } from "./Problem.tsx";
import { Side } from "./Side.tsx";
import { part } from "./shown.ts";

const Timeline = lazy(loadTimeline);

const PARTS = [
  ["write", "Write"],
  ["world", "World"],
  ["inspect", "Inspect"],
] as const;

export function App() {
  const writes = start.value.mode === "web";
  return (
    <div class={`page ${writes ? "with-bench" : ""}`} data-part={part.value}>
      <Header />
      <Problem />
      {writes && <DropPlace />}
      {writes && (
        <section class="bench" aria-label="Program and scenario">
          <Bench />
          <Divider />
        </section>
      )}
      <main class="stage" aria-label="World">
        <WorldView />
      </main>
      <aside class="side" aria-label="Inspector">
        <Side />
      </aside>
      <section class="time" aria-label="Time">
        <Transport />
        {run.opened.value && <Timeline />}
      </section>
      <nav class="parts" aria-label="Parts of the page">
        {PARTS.filter(([name]) => writes || name !== "write").map(([name, label]) => (
          <button
            key={name}
            type="button"
            aria-pressed={part.value === name}
            onClick={() => {
              part.value = name;
            }}
          >
            {label}
          </button>
        ))}
      </nav>
    </div>
  );
}
