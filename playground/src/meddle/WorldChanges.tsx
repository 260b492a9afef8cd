// Obstacles, waypoints and things: add, move and remove them.

import { useSignal } from "@preact/signals";
import { run } from "../app/context.ts";
import type { Intervention, Obstacle, Point } from "../engine/types.ts";
import { Choice, Numeric, Text } from "./inputs.tsx";
import { steer } from "./steering.ts";

export function WorldChanges() {
  const kind = useSignal("round");
  const name = useSignal("new");
  const [x, y, z] = [useSignal("1"), useSignal("1"), useSignal("0")];
  const [size, depth] = [useSignal("0.3"), useSignal("0.3")];
  const [group, hidden] = [useSignal("0"), useSignal(false)];
  const isObstacle = kind.value === "round" || kind.value === "box";
  const add = () => {
    const place = { x: Number(x.value), y: Number(y.value), z: Number(z.value) };
    if (kind.value === "way-point") {
      return steer({ set_way_point: { name: name.value, position: place, group: Number(group.value) } });
    }
    if (kind.value === "thing") return steer({ set_thing: { name: name.value, position: place } });
    const [width, breadth] = [Number(size.value), Number(depth.value)];
    const obstacle = kind.value === "round" ? round(place, width) : box(place, width, breadth);
    return steer({ add_obstacle: { obstacle, hidden: hidden.value } });
  };
  return (
    <>
      <div class="acts">
        <Choice label="What" value={kind}>
          <option value="round">round obstacle</option>
          <option value="box">rectangular obstacle</option>
          <option value="way-point">waypoint</option>
          <option value="thing">thing</option>
        </Choice>
        {!isObstacle && <Text label="Name" value={name} />}
        <Numeric label="x, m" value={x} />
        <Numeric label="y, m" value={y} />
        {!isObstacle && <Numeric label="z, m" value={z} />}
        {isObstacle && <Numeric label={kind.value === "round" ? "radius, m" : "width, m"} value={size} />}
        {kind.value === "box" && <Numeric label="depth, m" value={depth} />}
        {kind.value === "way-point" && <Numeric label="group" value={group} step="1" />}
        {isObstacle && (
          <label>
            <input
              type="checkbox"
              checked={hidden.value}
              onChange={(event) => {
                hidden.value = event.currentTarget.checked;
              }}
            />{" "}
            robots do not know it
          </label>
        )}
        <button type="button" onClick={add}>
          {isObstacle ? "Add" : "Add or move"}
        </button>
      </div>
      <Present />
    </>
  );
}

/** The existing items, which can be removed. */
function Present() {
  const chosen = useSignal("");
  const { obstacles, way_points, things } = run.world.value;
  const removals = new Map<string, Intervention>([
    ...way_points.map(({ name }) => [`waypoint ${name}`, { remove_way_point: { name } }] as const),
    ...things.map(({ name }) => [`thing ${name}`, { remove_thing: { name } }] as const),
    ...obstacles.map(({ index }) => [`obstacle ${index}`, { remove_obstacle: { index } }] as const),
  ]);
  if (removals.size === 0) return null;
  const removal = removals.get(chosen.value) ?? [...removals.values()][0];
  return (
    <div class="acts">
      <Choice label="Present" value={chosen}>
        {[...removals.keys()].map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </Choice>
      <button type="button" onClick={() => removal && steer(removal)}>
        Remove
      </button>
    </div>
  );
}

const round = (center: Point, radius: number): Obstacle => ({ Circle: { center, radius, height: null } });

function box({ x, y, z }: Point, width: number, depth: number): Obstacle {
  const corners = [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ] as const;
  const base = corners.map(([right, up]) => ({ x: x + (right * width) / 2, y: y + (up * depth) / 2, z }));
  return { Polygon: { base, height: null } };
}
