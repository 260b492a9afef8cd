// The world from above, to draw in: waypoints, obstacles and the starts of robots.

import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { content, edit } from "../document.ts";
import { nextName } from "../element.ts";
import { tablesOf } from "../table.ts";
import { backdrop, keepLooking } from "./backdrop.ts";
import {
  addObstacle,
  addStart,
  addWayPoint,
  erase,
  type Item,
  itemsOf,
  move,
  moved,
  type Point,
  type Shape,
} from "./items.ts";
import { drawn, snapped, type View, viewOf } from "./view.ts";

const TOOLS = [
  ["move", "Move", "Drag things; press Delete to remove the chosen one"],
  ["way-point", "Waypoint", "Click where it is to be"],
  ["start", "Robot", "Click where the robot is to start"],
  ["rectangle", "Rectangle", "Drag from corner to corner"],
  ["circle", "Circle", "Drag from the centre"],
  ["wall", "Wall", "Drag from end to end"],
] as const;

type Tool = (typeof TOOLS)[number][0];

/** The action of the pointer: it moves an item, or draws. */
interface Drag {
  from: Point;
  to: Point;
  item: Item | null;
  view: View;
}

const STEPS: Record<string, Point> = {
  ArrowLeft: [-0.1, 0],
  ArrowRight: [0.1, 0],
  ArrowUp: [0, 0.1],
  ArrowDown: [0, -0.1],
};

export function WorldMap() {
  const tool = useSignal<Tool>("move");
  const chosen = useSignal<string | null>(null);
  const group = useSignal(0);
  const zoom = useSignal(1);
  const drag = useSignal<Drag | null>(null);
  const svg = useRef<SVGSVGElement>(null);
  useEffect(keepLooking, []);

  const scenario = content.value ?? {};
  const items = itemsOf(scenario);
  const view = drag.value?.view ?? viewOf(items, backdrop.value, zoom.value);
  const unit = Math.max(view.width / 420, view.height / 260);
  const robots = tablesOf(scenario.robots);

  const pointAt = (event: PointerEvent): Point => {
    const matrix = svg.current?.getScreenCTM()?.inverse();
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
    return [x, -y];
  };
  const place = (at: Point) => {
    if (tool.value === "way-point") {
      const known = [
        ...items.filter(({ what }) => what === "way-point"),
        ...(backdrop.value?.wayPoints ?? []),
      ];
      const name = nextName(new Set(known.map(({ name }) => name)));
      edit((text) => addWayPoint(text, name, at));
    } else
      edit((text) => addStart(text, scenario, Math.min(group.value, Math.max(0, robots.length - 1)), at));
  };
  const onPointerDown = (event: PointerEvent) => {
    if (event.button !== 0 || content.value === null) return;
    const target = (event.target as Element).closest("[data-item]")?.getAttribute("data-item") ?? null;
    const item = tool.value === "move" ? (items.find(({ path }) => path.join(".") === target) ?? null) : null;
    const from = snapped(pointAt(event), view);
    chosen.value = item && target;
    if (tool.value === "way-point" || tool.value === "start") return place(from);
    if (tool.value === "move" && !item) return;
    svg.current?.setPointerCapture(event.pointerId);
    drag.value = { from, to: from, item, view };
  };
  const onPointerMove = (event: PointerEvent) => {
    if (drag.value) drag.value = { ...drag.value, to: snapped(pointAt(event), view) };
  };
  const onPointerUp = () => {
    const done = drag.value;
    drag.value = null;
    if (!done) return;
    const by = difference(done);
    const { item } = done;
    if (item && (by[0] !== 0 || by[1] !== 0)) edit((text) => move(text, scenario, item, by));
    const shape = item ? null : drawn(tool.value, done.from, done.to);
    if (shape) edit((text) => addObstacle(text, shape, tool.value === "rectangle"));
  };
  const onKeyDown = (event: KeyboardEvent, item: Item) => {
    const by = STEPS[event.key];
    const erases = event.key === "Delete" || event.key === "Backspace";
    if (!by && !erases) return;
    event.preventDefault();
    event.stopPropagation();
    edit((text) => (by ? move(text, scenario, item, by) : erase(text, item)));
  };
  const chosenItem = items.find(({ path }) => path.join(".") === chosen.value);
  const being = drag.value && !drag.value.item ? drawn(tool.value, drag.value.from, drag.value.to) : null;

  return (
    <div class="map">
      <div class="row tools">
        <div class="group">
          {TOOLS.map(([name, label, title]) => (
            <button
              key={name}
              type="button"
              aria-pressed={tool.value === name}
              title={title}
              onClick={() => {
                tool.value = name;
              }}
            >
              {label}
            </button>
          ))}
        </div>
        {tool.value === "start" && robots.length > 1 && (
          <select
            aria-label="Group of the robot"
            value={String(group.value)}
            onChange={(event) => {
              group.value = Number(event.currentTarget.value);
            }}
          >
            {robots.map((robot, index) => (
              <option key={`${robot.name ?? robot.model} ${index + 1}`} value={String(index)}>
                {String(robot.name ?? robot.model)}
              </option>
            ))}
          </select>
        )}
        <span class="spread" />
        <button
          type="button"
          disabled={!chosenItem}
          onClick={() => chosenItem && edit((text) => erase(text, chosenItem))}
        >
          Remove
        </button>
        <button
          type="button"
          aria-label="Show more of the world"
          title="Show more"
          onClick={() => (zoom.value *= 1.4)}
        >
          −
        </button>
        <button
          type="button"
          aria-label="Show less of the world"
          title="Show less"
          onClick={() => (zoom.value /= 1.4)}
        >
          +
        </button>
      </div>
      <svg
        ref={svg}
        aria-label="Map of the world"
        data-tool={tool.value}
        viewBox={`${view.left} ${-view.bottom - view.height} ${view.width} ${view.height}`}
        onPointerDown={onPointerDown}
        onPointerMove={onPointerMove}
        onPointerUp={onPointerUp}
        onPointerCancel={() => {
          drag.value = null;
        }}
      >
        <Grid view={view} unit={unit} />
        <Behind unit={unit} items={items} />
        {items.map((item) => {
          const key = item.path.join(".");
          const isDragged = drag.value?.item?.path.join(".") === key;
          const shape = drag.value && isDragged ? moved(item.shape, difference(drag.value)) : item.shape;
          return (
            // biome-ignore lint/a11y/useSemanticElements: there are no buttons in a drawing
            <g
              key={key}
              data-item={key}
              class={`item ${item.what} ${item.hidden ? "hidden" : ""} ${key === chosen.value ? "chosen" : ""}`}
              tabIndex={0}
              role="button"
              aria-label={`${item.what} ${item.name}: arrow keys move it, Delete removes it`}
              onFocus={() => {
                chosen.value = key;
              }}
              onKeyDown={(event) => onKeyDown(event, item)}
            >
              <Drawing shape={shape} what={item.what} name={item.name} unit={unit} />
            </g>
          );
        })}
        {being && (
          <g class="item obstacle being">
            <Drawing shape={being} what="obstacle" name="" unit={unit} />
          </g>
        )}
      </svg>
    </div>
  );
}

const difference = ({ from, to }: Drag): Point => [to[0] - from[0], to[1] - from[1]];

function Drawing({
  shape,
  what,
  name,
  unit,
}: {
  shape: Shape;
  what: Item["what"];
  name: string;
  unit: number;
}) {
  if (shape.kind === "circle") return <circle cx={shape.center[0]} cy={-shape.center[1]} r={shape.radius} />;
  if (shape.kind === "polygon") return <polygon points={corners(shape.corners)} stroke-width={3 * unit} />;
  const [x, y] = [shape.at[0], -shape.at[1]];
  return (
    <>
      {/* Large enough for a finger. */}
      <circle class="touch" cx={x} cy={y} r={12 * unit} />
      {what === "way-point" ? (
        <path
          d={`M${x - 6 * unit} ${y}h${12 * unit}m${-6 * unit} ${-6 * unit}v${12 * unit}`}
          stroke-width={2.5 * unit}
        />
      ) : what === "thing" ? (
        <rect x={x - 5 * unit} y={y - 5 * unit} width={10 * unit} height={10 * unit} />
      ) : (
        <circle class="start" cx={x} cy={y} r={7 * unit} />
      )}
      <text x={x + 9 * unit} y={y - 5 * unit} font-size={12 * unit}>
        {name}
      </text>
    </>
  );
}

/** Other items that the simulator reads: from world files, or placed at random. */
function Behind({ unit, items }: { unit: number; items: Item[] }) {
  const shown = backdrop.value;
  if (!shown) return null;
  const names = new Set(items.map(({ name }) => name));
  const placed = items.flatMap(({ what, shape }) =>
    what === "start" && shape.kind === "point" ? [shape.at] : [],
  );
  const isPlaced = ([x, y]: Point) => placed.some(([a, b]) => Math.hypot(a - x, b - y) < 0.01);
  return (
    <g class="behind">
      {shown.obstacles.map((points) => (
        <polygon key={corners(points)} points={corners(points)} stroke-width={2 * unit} />
      ))}
      {shown.wayPoints
        .filter(({ name }) => !names.has(name))
        .map(({ name, at: [x, y] }) => (
          <g key={name}>
            <path
              d={`M${x - 4 * unit} ${-y}h${8 * unit}m${-4 * unit} ${-4 * unit}v${8 * unit}`}
              stroke-width={1.5 * unit}
            />
            {shown.wayPoints.length < 30 && (
              <text x={x + 6 * unit} y={-y - 4 * unit} font-size={11 * unit}>
                {name}
              </text>
            )}
          </g>
        ))}
      {shown.robots
        .filter(({ at }) => !isPlaced(at))
        .map(({ name, at: [x, y], radius }) => (
          <circle key={name} cx={x} cy={-y} r={Math.max(radius, 3 * unit)} stroke-width={1.5 * unit}>
            <title>{name}</title>
          </circle>
        ))}
    </g>
  );
}

function Grid({ view, unit }: { view: View; unit: number }) {
  const step = 10 ** Math.ceil(Math.log10(Math.max(view.width, view.height) / 12));
  const lines: string[] = [];
  for (let x = Math.ceil(view.left / step) * step; x <= view.left + view.width; x += step) {
    lines.push(`M${x} ${-view.bottom}v${-view.height}`);
  }
  for (let y = Math.ceil(view.bottom / step) * step; y <= view.bottom + view.height; y += step) {
    lines.push(`M${view.left} ${-y}h${view.width}`);
  }
  return <path class="grid" d={lines.join("")} stroke-width={unit} />;
}

const corners = (points: Point[]): string => points.map(([x, y]) => `${x},${-y}`).join(" ");
