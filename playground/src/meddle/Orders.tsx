// An operator tells robots something; robots join.

import { useSignal } from "@preact/signals";
import { run } from "../app/context.ts";
import { readFields } from "./fields.ts";
import { Choice, Numeric, Text } from "./inputs.tsx";
import { said, steer } from "./steering.ts";
import { byName, target, targets } from "./targets.ts";

export function Orders() {
  const order = useSignal("");
  const fields = useSignal("");
  const tell = () => {
    try {
      const list = readFields(fields.value, byName());
      const robots = target.value === "all" ? [] : targets.value;
      void steer({ tell: { robots, order: { name: order.value.trim(), fields: list } } });
    } catch (error) {
      said.value = { good: false, text: `The fields cannot be read: ${(error as Error).message}` };
    }
  };
  const nobody = target.value !== "all" && targets.value.length === 0;
  return (
    <>
      <p class="muted">A program receives an order in its handler of the same name.</p>
      <Text label="Order" value={order} placeholder="go_home" />
      <label class="field">
        <span>Fields, one a line</span>
        <textarea
          rows={3}
          placeholder={"to = (0.5, 1)\ncount = 3"}
          value={fields.value}
          onInput={(event) => {
            fields.value = event.currentTarget.value;
          }}
        />
      </label>
      <div class="acts">
        <button type="button" disabled={nobody || order.value.trim() === ""} onClick={tell}>
          Tell {target.value === "all" ? "all robots" : "these robots"}
        </button>
      </div>
      <Join />
    </>
  );
}

function Join() {
  const like = useSignal("0");
  const name = useSignal("late");
  const [x, y, z, heading] = [useSignal("0"), useSignal("0"), useSignal("0"), useSignal("0")];
  const join = () =>
    steer({
      join: {
        like: Number(like.value),
        name: name.value.trim(),
        pose: {
          position: { x: Number(x.value), y: Number(y.value), z: Number(z.value) },
          yaw: (Number(heading.value) * Math.PI) / 180,
          pitch: 0,
          roll: 0,
        },
      },
    });
  return (
    <div class="acts">
      <Text label="A robot joins, called" value={name} />
      <Choice label="like" value={like}>
        {run.fleet.value.slice(0, 200).map(({ id, name }) => (
          <option key={id} value={String(id)}>
            {name}
          </option>
        ))}
      </Choice>
      <Numeric label="x, m" value={x} />
      <Numeric label="y, m" value={y} />
      <Numeric label="z, m" value={z} />
      <Numeric label="heading, °" value={heading} />
      <button type="button" disabled={name.value.trim() === ""} onClick={join}>
        Join
      </button>
    </div>
  );
}
