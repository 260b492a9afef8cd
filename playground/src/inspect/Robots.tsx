// The fleet, and all there is to see of the robots that a person has chosen.

import { run } from "../app/context.ts";
import { Fleet } from "./Fleet.tsx";
import { Looked } from "./Looked.tsx";
import { Recorded } from "./Recorded.tsx";
import "../styles/inspect.css";

export function Robots() {
  const chosen = run.selected.value.length > 0;
  return (
    <div class="robots">
      <Fleet />
      {!chosen && <p class="muted">Choose a robot to inspect it.</p>}
      {chosen && (run.live.value ? <Looked /> : <Recorded />)}
    </div>
  );
}
