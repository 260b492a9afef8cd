// What the page shows first: what its address names, or what was shown last.

import { benchTab } from "../app/Bench.tsx";
import { run } from "../app/context.ts";
import { openExample } from "../gallery/examples.ts";
import { keepChecking } from "./checking.ts";
import { returning } from "./project.ts";
import { runProject } from "./running.ts";

export async function begin(): Promise<void> {
  keepChecking();
  const example = new URLSearchParams(location.search).get("example");
  if (example) {
    // Another visit to the page goes on with what was made of the example.
    history.replaceState(null, "", location.pathname);
    await openExample(example, { play: false });
  } else if (returning) {
    benchTab.value = "program";
    // What is not finished yet is no reason for a message.
    if (!(await runProject({ play: false }))) run.problem.value = null;
  }
}
