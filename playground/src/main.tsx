// Starts the page.

import { render } from "preact";
import { App } from "./app/App.tsx";
import { askHost, expectsRun, run, start } from "./app/context.ts";
import { loadRobots, loadScreen, loadStage, loadTimeline } from "./app/loads.ts";
import { simulator } from "./engine/simulator.ts";
import { begin } from "./project/begin.ts";
import { returning } from "./project/project.ts";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/controls.css";

// Everything that a run needs loads at once: the module (build/preload.ts), the worker, what the host shows, and what
// paints runs.
const asked = askHost();
void asked.then(({ mode }) => mode === "web" && simulator().catch(() => undefined));

const page = document.getElementById("page");
if (!page) throw new Error("index.html has an element #page");
// Every visit except the first shows a run, and so does one whose address names what to show.
expectsRun.value = returning || location.search !== "";
render(<App />, page);
if (expectsRun.value) {
  for (const load of [loadScreen, loadStage, loadRobots, loadTimeline]) load().catch(() => undefined);
}

/** The time after which the page keeps itself for visits without a network, so that it does not delay the first run, ms. */
const REST = 2000;

start.value = await asked;
switch (start.value.mode) {
  case "run":
    await run.open({ kind: "server", opened: start.value.opened });
    break;
  case "trace":
    await run.open({ kind: "trace", name: start.value.name, from: new URL("trace", location.href).href });
    break;
  case "fleet":
    if (await run.open({ kind: "fleet", name: start.value.name, from: new URL("trace", location.href).href }))
      run.play();
    break;
  case "web":
    if (expectsRun.value) import("./editor/pane.ts").catch(() => undefined);
    await begin();
    // The command serves no service worker: another command may use the same port later.
    if (start.value.static && import.meta.env.PROD)
      setTimeout(() => navigator.serviceWorker?.register("./sw.js"), REST);
    break;
}
