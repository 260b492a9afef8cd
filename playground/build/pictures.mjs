// Draws the pictures of the gallery: runs each example in the WebAssembly module and writes small SVG files.
//
//     npm run pictures
//
// Run it again when an example has changed. Seen from above, with the paths of robots; where they stand still, the
// messages between them. Colours are readable on light and dark ground.

import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { load, POSE_NUMBERS } from "../../apps/starl-wasm/starl.mjs";

const HERE = new URL(".", import.meta.url);
const OUT = new URL("../src/gallery/pictures/", HERE);
/** Of the picture. */
const [WIDTH, HEIGHT, EDGE] = [240, 150, 10];
/** Paths may differ from the true ones by so many pixels. */
const TOLERANCE = 0.6;
const COLORS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#b0763c", "#7a5ac8", "#a89a00"];
/** Simulated time that is drawn, s; a hundred cars for a shorter time, since otherwise nothing could be distinguished. */
const LONGEST = 90;
const FLEET_OF_MANY = 50;

function picture({ files, scenario }) {
  const run = starl.open(files, { scenario, topics: ["/starl/sent", "/starl/delivered"] });
  const fleet = run.fleet();
  run.run({ until: fleet.length > FLEET_OF_MANY ? 25 : LONGEST, sample: 0.25 });
  const frames = split(run.frames());
  const { records } = run.records();
  const world = run.world();
  run.close();
  const paths = fleet.map((_, robot) =>
    frames.filter((frame) => robot * POSE_NUMBERS < frame.length).map((frame) => at(frame, robot)),
  );
  const moves = paths.some((path) => length(path) > 0.3);
  const shapes = world.obstacles.map(({ obstacle }) => corners(obstacle));
  const points = [...paths.flat(), ...world.way_points.map(({ position: { x, y } }) => [x, y])];
  if (!moves) return wrap(diagram(records, fleet.length));
  const place = fleet.length > FLEET_OF_MANY ? view(middle(points), []) : view(points, shapes);
  const parts = [
    '<g fill="#8b96a1" stroke="#8b96a1">',
    ...shapes.map((shape) => draw(shape, place, "", true)),
    "</g>",
  ];
  paths.forEach((path, robot) => {
    const color = COLORS[robot % COLORS.length];
    const line = simplify(path.map(place), TOLERANCE);
    if (length(path) > 0.05)
      parts.push(draw(line, (point) => point, `fill="none" stroke="${color}" stroke-width="1.6"`, false));
    const [start, end] = [line[0], line.at(-1)];
    parts.push(
      `<circle cx="${round(start[0])}" cy="${round(start[1])}" r="2.5" fill="none" stroke="${color}"/>`,
    );
    parts.push(`<circle cx="${round(end[0])}" cy="${round(end[1])}" r="3" fill="${color}"/>`);
  });
  for (const { position } of world.way_points.length > 60 ? [] : world.way_points) {
    const [x, y] = place([position.x, position.y]);
    parts.push(`<path d="M${round(x - 3)} ${round(y)}h6m-3-3v6" stroke="#d81b60" stroke-width="1.4"/>`);
  }
  return wrap(parts);
}

function wrap(parts) {
  const head = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${HEIGHT}" width="${WIDTH}" height="${HEIGHT}">`;
  return `${head}${parts.join("")}</svg>\n`;
}

/** The first messages of robots that stand still: a line for each robot, time from left to right. */
function diagram(records, robots) {
  const sent = new Map();
  const arrivals = [];
  for (const { topic, time_ns, message } of records) {
    if (topic === "/starl/sent") sent.set(`${message.robot} ${message.sequence}`, time_ns);
    else arrivals.push({ ...message, at: time_ns, began: sent.get(`${message.from} ${message.sequence}`) });
  }
  const shown = arrivals.filter(({ began }) => began !== undefined).slice(0, 42);
  const [first, last] = [
    Math.min(...shown.map(({ began }) => began)),
    Math.max(...shown.map(({ at }) => at)),
  ];
  const x = (time) => round(EDGE + 8 + ((time - first) / (last - first)) * (WIDTH - 2 * EDGE - 8));
  const y = (robot) => round(EDGE + 10 + (robot / Math.max(1, robots - 1)) * (HEIGHT - 2 * EDGE - 20));
  const parts = [];
  for (let robot = 0; robot < robots; robot++) {
    const color = COLORS[robot % COLORS.length];
    parts.push(
      `<path d="M${EDGE} ${y(robot)}H${WIDTH - EDGE}" stroke="${color}"/><circle cx="${EDGE}" cy="${y(robot)}" r="4" fill="${color}"/>`,
    );
  }
  for (const { from, robot, began, at } of shown) {
    const color = COLORS[from % COLORS.length];
    parts.push(
      `<path d="M${x(began)} ${y(from)}L${x(at)} ${y(robot)}" stroke="${color}" stroke-width="1.6"/>`,
    );
  }
  return parts;
}

/** The quarter of many points that lies around their middle. */
function middle(points) {
  const median = (axis) =>
    points.map((point) => point[axis]).sort((one, other) => one - other)[points.length >> 1];
  const [x, y] = [median(0), median(1)];
  const far = ([a, b]) => Math.hypot(a - x, b - y);
  return [...points].sort((one, other) => far(one) - far(other)).slice(0, points.length >> 2);
}

function split(numbers) {
  const frames = [];
  for (let from = 0; from < numbers.length; ) {
    const end = from + 2 + numbers[from + 1] * POSE_NUMBERS;
    frames.push(numbers.slice(from + 2, end));
    from = end;
  }
  return frames;
}

const at = (frame, robot) => [frame[robot * POSE_NUMBERS], frame[robot * POSE_NUMBERS + 1]];

function corners({ Polygon: polygon, Circle: circle, Cuboid: cuboid }) {
  if (polygon) return polygon.base.map(({ x, y }) => [x, y]);
  if (cuboid) {
    const { low, high } = cuboid;
    return [
      [low.x, low.y],
      [high.x, low.y],
      [high.x, high.y],
      [low.x, high.y],
    ];
  }
  const turn = (index) => (index / 16) * 2 * Math.PI;
  const { center, radius } = circle;
  return Array.from({ length: 16 }, (_, index) => [
    center.x + radius * Math.cos(turn(index)),
    center.y + radius * Math.sin(turn(index)),
  ]);
}

/** From metres to pixels: what moves is in the middle and fills the picture. */
function view(points, shapes) {
  const box = (all) =>
    [0, 1].map((axis) => [
      Math.min(...all.map((point) => point[axis])),
      Math.max(...all.map((point) => point[axis])),
    ]);
  const whole = shapes.flat().length > 0 && shapes.length < 40 ? [...points, ...shapes.flat()] : points;
  const [[left, right], [bottom, top]] = box(whole);
  const scale = Math.min(
    (WIDTH - 2 * EDGE) / Math.max(0.5, right - left),
    (HEIGHT - 2 * EDGE) / Math.max(0.5, top - bottom),
  );
  const [x, y] = [(left + right) / 2, (bottom + top) / 2];
  return (point) => [WIDTH / 2 + (point[0] - x) * scale, HEIGHT / 2 - (point[1] - y) * scale];
}

function draw(points, place, style, closed) {
  const path = points.map(place).map(([x, y], index) => `${index === 0 ? "M" : "L"}${round(x)} ${round(y)}`);
  return `<path d="${path.join("")}${closed ? "Z" : ""}" ${style}/>`;
}

const length = (path) =>
  path.reduce(
    (sum, [x, y], index) => (index ? sum + Math.hypot(x - path[index - 1][0], y - path[index - 1][1]) : 0),
    0,
  );

/** Ramer, Douglas and Peucker: leaves out points that lie on the line between others. */
function simplify(points, tolerance) {
  if (points.length < 3) return points;
  const [from, to] = [points[0], points.at(-1)];
  let [farthest, worst] = [0, 0];
  for (let index = 1; index < points.length - 1; index++) {
    const off = distance(points[index], from, to);
    if (off > worst) [farthest, worst] = [index, off];
  }
  if (worst < tolerance) return [from, to];
  return [
    ...simplify(points.slice(0, farthest + 1), tolerance).slice(0, -1),
    ...simplify(points.slice(farthest), tolerance),
  ];
}

function distance([x, y], [a, b], [c, d]) {
  const span = Math.hypot(c - a, d - b);
  if (span === 0) return Math.hypot(x - a, y - b);
  return Math.abs((c - a) * (b - y) - (a - x) * (d - b)) / span;
}

const round = (number) => Math.round(number * 10) / 10;

const starl = await load(readFileSync(new URL("../wasm/starl.wasm", HERE)));
mkdirSync(OUT, { recursive: true });
for (const example of starl.examples()) {
  const svg = picture(example);
  writeFileSync(new URL(`${example.name}.svg`, OUT), svg);
  console.log(`${example.name}.svg`, svg.length);
}
