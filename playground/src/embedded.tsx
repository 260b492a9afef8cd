// Starts the page inside another one, such as a notebook: one file, which holds the run that it shows and asks no server
// for anything. build/embedded.ts makes it.

import { render } from "preact";
import { App } from "./app/App.tsx";
import { run, start } from "./app/context.ts";
import "./styles/base.css";
import "./styles/layout.css";
import "./styles/controls.css";

/** The bytes that an element of the file holds, packed with gzip and in base 64. */
async function held(id: string): Promise<Blob> {
  const text = document.getElementById(id)?.textContent?.trim() ?? "";
  const packed = new Blob([Uint8Array.from(atob(text), (byte) => byte.charCodeAt(0))]);
  return new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).blob();
}

const { name, live }: { name: string; live: boolean } = JSON.parse(await (await held("starl-run")).text());
start.value = { mode: "embedded", name, live };
render(<App />, document.getElementById("page") as HTMLElement);
await run.open({ kind: "trace", name, from: await held("starl-trace") });
if (live) await run.open({ kind: "again" });
