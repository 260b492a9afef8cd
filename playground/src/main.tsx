// Starts the page.

import { render } from "preact";
import { App } from "./app/App.tsx";
import { askHost, run, start } from "./app/context.ts";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/controls.css";

const page = document.getElementById("page");
if (!page) throw new Error("index.html has an element #page");
render(<App />, page);

start.value = await askHost();
switch (start.value.mode) {
  case "run":
    await run.open({ kind: "server", opened: start.value.opened });
    break;
  case "trace":
    await run.open({ kind: "trace", name: start.value.name, from: new URL("trace", location.href).href });
    break;
  case "web":
    await openExample(new URLSearchParams(location.search).get("example"));
    if (import.meta.env.PROD) await navigator.serviceWorker?.register("./sw.js").catch(() => undefined);
    break;
}

async function openExample(name: string | null): Promise<void> {
  if (name) await run.open({ kind: "files", files: {}, options: { scenario: name } });
}
