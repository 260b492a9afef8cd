// Steers the run: faults, the network, the world, orders, robots that join and leave. Everything that is done is
// recorded, and the run with it can be saved as a scenario.

import { run } from "../app/context.ts";
import { download } from "../app/download.ts";
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
        run goes on from here.
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
        <button type="button" onClick={save}>
          Save as scenario
        </button>
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

async function save(): Promise<void> {
  try {
    const name = run.opened.value?.title.toLowerCase().replace(/[^a-z0-9]+/g, "-") || "run";
    download(`${name}.toml`, "application/toml", await run.scenario());
  } catch (error) {
    said.value = { good: false, text: error instanceof Error ? error.message : String(error) };
  }
}
