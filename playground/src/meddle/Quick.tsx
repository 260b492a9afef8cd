// Actions on an inspected robot.

import type { Condition } from "../engine/types.ts";
import { nameOf } from "../inspect/names.ts";
import { said, steerAndShow } from "./steering.ts";

export function Quick({ robot, condition }: { robot: number; condition: Condition }) {
  if (condition === "left") return null;
  const down = condition === "down";
  return (
    <span class="quick">
      {!down && (
        <button
          type="button"
          class="small"
          aria-label={`Crash ${nameOf(robot)}`}
          onClick={() => steerAndShow({ fault: { crash: [robot] } })}
        >
          Crash
        </button>
      )}
      <button
        type="button"
        class="small"
        aria-label={`Restart ${nameOf(robot)}`}
        onClick={() => steerAndShow({ fault: { restart: [robot] } })}
      >
        Restart
      </button>
      {said.value && !said.value.good && (
        <span class="refused" role="alert">
          {said.value.text}
        </span>
      )}
    </span>
  );
}
