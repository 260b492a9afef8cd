// The initial project of the page: the one in its address, or the last one.

import { run } from "../app/context.ts";
import { benchTab, part } from "../app/shown.ts";
import { openExample } from "../gallery/examples.ts";
import { keepChecking } from "./checking.ts";
import { returning } from "./project.ts";
import { runProject, starting } from "./running.ts";

export async function begin(): Promise<void> {
  keepChecking();
  const example = new URLSearchParams(location.search).get("example");
  if (example) {
    // Another visit to the page continues with the edited example.
    history.replaceState(null, "", location.pathname);
    await openExample(example, { play: false });
  } else if (returning) {
    benchTab.value = "program";
    // A person may have pressed Run already. Unfinished input causes no message.
    if (!starting.value && !run.opened.value && !(await runProject({ play: false })))
      run.problem.value = null;
  } else {
    // A small screen shows one part at a time, and there is no run to see yet.
    part.value = "write";
  }
}
