// StarL's simulator for JavaScript: Node.js from 18, browsers and workers. Types and units: starl.d.mts.
//
// Requests and answers pass through one buffer of the WebAssembly module as JSON; poses and frames are read in
// place.

// The module's memory does not grow further: build.rs.
const MOST_MEMORY = 2 ** 30;

/** An error of StarL, with its single problems if there are any. */
export class StarlError extends Error {
  constructor(message, diagnostics = []) {
    super(message);
    this.name = "StarlError";
    this.diagnostics = diagnostics;
  }
}

/** The number of elements of `poses()` that belong to each robot. */
export const POSE_NUMBERS = 11;

/** Loads the module and makes an instance of it. */
export async function load(source = new URL("./starl_wasm.wasm", import.meta.url)) {
  return new Starl(await instantiate(source));
}

async function instantiate(source) {
  if (source instanceof WebAssembly.Module) return WebAssembly.instantiate(source, {});
  if (ArrayBuffer.isView(source) || source instanceof ArrayBuffer) {
    return (await WebAssembly.instantiate(source, {})).instance;
  }
  if (typeof Response !== "undefined" && source instanceof Response) return instantiateResponse(source);
  const url = new URL(source, import.meta.url);
  if (url.protocol === "file:") {
    const { readFile } = await import("node:fs/promises");
    return (await WebAssembly.instantiate(await readFile(url), {})).instance;
  }
  return instantiateResponse(await fetch(url));
}

async function instantiateResponse(response) {
  if (!response.ok) throw new StarlError(`${response.url}: ${response.status} ${response.statusText}`);
  // A browser compiles the module while it loads, and keeps the code, if the server names its type.
  if (/^application\/wasm\b/i.test(response.headers.get("content-type") ?? "") && WebAssembly.instantiateStreaming) {
    return (await WebAssembly.instantiateStreaming(response, {})).instance;
  }
  return (await WebAssembly.instantiate(await response.arrayBuffer(), {})).instance;
}

/** An instance of the simulator. It holds any number of simulations. */
export class Starl {
  #exports;
  #failure = null;

  constructor(instance) {
    this.#exports = instance.exports;
  }

  examples() {
    return this.request({ examples: {} });
  }

  check(files) {
    return this.request({ check: { files: contents(files) } });
  }

  schema() {
    return this.request({ schema: {} });
  }

  hover(files, path, position) {
    return this.request({ hover: { files: contents(files), path, position } });
  }

  complete(files, path, position) {
    return this.request({ complete: { files: contents(files), path, position } });
  }

  definition(files, path, position) {
    return this.request({ definition: { files: contents(files), path, position } });
  }

  outline(files, path) {
    return this.request({ outline: { files: contents(files), path } });
  }

  format(text) {
    return this.request({ format: { text } });
  }

  profiles() {
    return this.request({ profiles: {} });
  }

  try(files, options, profile, seed) {
    return this.request({ try: trial(files, options, profile, seed) });
  }

  profileScenario(files, options, profile, seed) {
    return this.request({ profile_scenario: trial(files, options, profile, seed) });
  }

  shrink(files, options, profile, seed, { most } = {}) {
    return this.request({ shrink: { ...trial(files, options, profile, seed), most } });
  }

  open(files, options = {}) {
    const { topics, ...rest } = options;
    const open = target(files, rest);
    if (topics !== undefined) open.topics = [...topics];
    return new Simulation(this, this.request({ open }));
  }

  openRecorded(recorded, { topics } = {}) {
    const open_recorded = { recorded, topics: topics && Array.from(topics) };
    return new Simulation(this, this.request({ open_recorded }));
  }

  /** Passes a request to the module, and returns its answer. */
  request(request) {
    return this.#guarded((exports) => {
      const text = JSON.stringify(request);
      if (text === undefined) throw new StarlError("the request is no JSON");
      const bytes = new TextEncoder().encode(text);
      const at = exports.buffer(bytes.length);
      new Uint8Array(exports.memory.buffer, at, bytes.length).set(bytes);
      const length = exports.call();
      const { ok, error } = JSON.parse(read(exports, length));
      if (error) throw new StarlError(error.message, error.diagnostics);
      return ok;
    });
  }

  /** The poses of a simulation's robots, in the memory of the module. */
  poses(simulation) {
    return this.#numbers(simulation, "poses", "poses_at");
  }

  /** The frames of a simulation that were not taken yet, in the memory of the module. */
  frames(simulation) {
    return this.#numbers(simulation, "frames", "frames_at");
  }

  #numbers(simulation, take, place) {
    return this.#guarded((exports) => {
      const count = exports[take](simulation);
      if (count < 0) throw new StarlError(`there is no simulation ${simulation}; it may have been closed`);
      // The buffer is asked for last: a call may let the memory grow, which detaches it.
      const at = exports[place]();
      return new Float64Array(exports.memory.buffer, at, count);
    });
  }

  get failed() {
    return this.#failure !== null;
  }

  /** An instance cannot be used after a trap. */
  #guarded(run) {
    if (this.#failure) throw new StarlError(this.#failure);
    const exports = this.#exports;
    try {
      return run(exports);
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      const panic = read(exports, exports.failure());
      // Only a lack of memory ends without the message of a panic. Memory grows in leaps, so the last one counts.
      const full = exports.memory.buffer.byteLength > MOST_MEMORY / 2;
      this.#failure =
        !panic && full
          ? "the simulations need more memory than the 1 GiB that there is; use fewer robots, then load StarL anew"
          : `StarL has failed, which is a fault of StarL; load it anew: ${panic || error.message}`;
      throw new StarlError(this.#failure);
    }
  }
}

/** One simulation. */
export class Simulation {
  #starl;
  #id;

  constructor(starl, { simulation, ...about }) {
    this.#starl = starl;
    this.#id = simulation;
    Object.assign(this, about);
    Object.freeze(this);
  }

  #request(name, parameters = {}) {
    return this.#starl.request({ [name]: { simulation: this.#id, ...parameters } });
  }

  close() {
    this.#request("close");
  }

  status() {
    return this.#request("status");
  }

  step() {
    return this.#request("step");
  }

  run({ until, steps, sample } = {}) {
    const end = until === Infinity ? undefined : moment(until);
    return this.#request("run", { until: end, steps, sample: moment(sample) });
  }

  breakpoints(breakpoints) {
    this.#request("breakpoints", { breakpoints });
  }

  apply(intervention, { at } = {}) {
    this.#request("apply", { at: moment(at), intervention });
  }

  snapshot() {
    return this.#request("snapshot");
  }

  restore(snapshot) {
    return this.#request("restore", { snapshot });
  }

  drop(snapshot) {
    this.#request("drop", { snapshot });
  }

  scenario() {
    return this.#request("scenario");
  }

  trace() {
    return Uint8Array.from(atob(this.#request("trace")), (character) => character.charCodeAt(0));
  }

  records(max) {
    return this.#request("records", { max });
  }

  world() {
    return this.#request("world");
  }

  fleet() {
    return this.#request("fleet");
  }

  states() {
    return this.#request("states");
  }

  values() {
    return this.#request("values");
  }

  robot(robot) {
    return this.#request("robot", { robot });
  }

  report() {
    return this.#request("report");
  }

  poses() {
    return this.#starl.poses(this.#id);
  }

  frames() {
    return this.#starl.frames(this.#id);
  }
}

// JSON has no NaN: it would be read as a moment that is not given.
function moment(seconds) {
  if (seconds === undefined || Number.isFinite(seconds)) return seconds;
  throw new StarlError(`${seconds} is not a time; give seconds from 0`);
}

function read(exports, length) {
  return new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.answer(), length));
}

function target(files, options = {}) {
  const { seed } = options;
  return { files: contents(files), options: seed === undefined ? options : { ...options, seed: String(seed) } };
}

function trial(files, options, profile, seed) {
  return { ...target(files, options), profile, seed: String(seed) };
}

function contents(files) {
  const content = (file) => (typeof file === "string" ? file : Array.from(file));
  return Object.fromEntries(Object.entries(files ?? {}).map(([path, file]) => [path, content(file)]));
}
