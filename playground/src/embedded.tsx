// Starts the page inside another one, such as a notebook: one file, which holds the run that it shows and asks no server
// for anything. build/embedded.ts makes it.

import { render } from "preact";
import { App } from "./app/App.tsx";
import { run, start } from "./app/context.ts";
import { held } from "./held.ts";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/controls.css";

const { name, live }: { name: string; live: boolean } = JSON.parse(await (await held("starl-run")).text());
start.value = { mode: "embedded", name, live };
render(<App />, document.getElementById("page") as HTMLElement);
await run.open({ kind: "trace", name, from: await held("starl-trace") });
if (live) await run.open({ kind: "again" });
