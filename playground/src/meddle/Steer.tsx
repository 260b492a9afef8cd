// Steers the run: faults, the network, the world, orders, robots that join and leave. Everything that is done is
// recorded, and the run with it can be saved as a scenario.

import { run } from "../app/context.ts";
import { download } from "../app/download.ts";
import { zip } from "../share/zip.ts";
import { Applied } from "./Applied.tsx";
import { Network } from "./Network.tsx";
import { Orders } from "./Orders.tsx";
import { RobotFaults } from "./RobotFaults.tsx";
import { said } from "./steering.ts";
import { WorldChanges } from "./WorldChanges.tsx";
import "../styles/steer.css";

export function Steer() {
  return (
    <div class="steer">
      <p class="muted">
        What you do here happens at the moment shown. What was known of later moments is forgotten, and the
        run continues from here.
      </p>
      <p class={`said ${said.value?.good ? "good" : "bad"}`} role="status">
        {said.value?.text}
      </p>
      <Part title="Robots" open>
        <RobotFaults />
      </Part>
      <Part title="Network" open>
        <Network />
      </Part>
      <Part title="World">
        <WorldChanges />
      </Part>
      <Part title="Orders and new robots">
        <Orders />
      </Part>
      <Part title="What was done" open>
        <Applied />
        <Save />
      </Part>
    </div>
  );
}

function Part({
  title,
  open = false,
  children,
}: {
  title: string;
  open?: boolean;
  children: preact.ComponentChildren;
}) {
  return (
    <details open={open}>
      <summary>
        <h2>{title}</h2>
      </summary>
      {children}
    </details>
  );
}

/** The file of the steered run. It names programs, which stand in other files. */
function Save() {
  const source = run.source.value;
  const programs = source?.kind === "files" ? source.files : null;
  const name = `${run.opened.value?.title.toLowerCase().replace(/[^a-z0-9]+/g, "-") || "run"}-steered`;
  return (
    <div class="acts">
      <button
        type="button"
        title="Repeats this run: starl run FILE"
        onClick={() => saveAs((scenario) => download(`${name}.toml`, "application/toml", scenario))}
      >
        Save as scenario
      </button>
      {programs && (
        <button
          type="button"
          title="The scenario with the programs that it names, ready for the command"
          onClick={() =>
            saveAs((scenario) => {
              const files = new Blob([zip({ [`${name}.toml`]: scenario, ...programs })]);
              download(`${name}.zip`, "application/zip", files);
            })
          }
        >
          With its programs (.zip)
        </button>
      )}
    </div>
  );
}

async function saveAs(give: (scenario: string) => void): Promise<void> {
  try {
    give(await run.scenario());
  } catch (error) {
    said.value = { good: false, text: error instanceof Error ? error.message : String(error) };
  }
}
