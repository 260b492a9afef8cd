// Types of starl.mjs. Unless something else is said: times are seconds since the start of the run, lengths are
// metres, angles are radians, and places are in one right-handed world frame with z up.

/** Files by path. Paths are relative, with `/` between their parts. */
export type Files = Record<string, string | Uint8Array>;

/** What StarL refuses. */
export class StarlError extends Error {
  /** The single problems; empty where there is no more to say than the message does. */
  readonly diagnostics: Diagnostic[];
}

/** So many numbers of `poses()` and of a frame belong to each robot. */
export const POSE_NUMBERS: 11;

/**
 * Loads the module, by default `starl_wasm.wasm` beside this file, and makes an instance of it.
 * Instances share nothing.
 */
export function load(source?: string | URL | Response | BufferSource | WebAssembly.Module): Promise<Starl>;

/** An instance of the simulator. It holds any number of simulations, in 1 GiB of memory. */
export class Starl {
  private constructor();
  /** Whether it cannot continue: every call throws a StarlError that says why. Load another instance. */
  readonly failed: boolean;
  /** The examples that come with StarL. */
  examples(): Example[];
  /** All that is wrong with programs and libraries (`.starl`) and scenarios (`.toml`), by file and place. */
  check(files: Files): Diagnostic[];
  /** The fields of scenario files as a JSON Schema (draft 2020-12), with members `x-...` for forms. */
  schema(): Schema;
  /** What to show at a place of a program or library; null where there is no name. */
  hover(files: Files, path: string, position: Position): Hover | null;
  /** What may be typed at a place of a program or library, the likeliest first. */
  complete(files: Files, path: string, position: Position): Completion[];
  /** Where that is declared which is named at a place; null for what is built in, and where there is no name. */
  definition(files: Files, path: string, position: Position): Definition | null;
  /** The parts of a program or library, in the order of the text. */
  outline(files: Files, path: string): OutlinePart[];
  /** The text of a program or library as the formatter lays it out. */
  format(text: string): string;
  /** The profiles of faults that runs can be tried under. */
  profiles(): Profile[];
  /**
   * Runs a scenario with the faults that a profile draws from a seed, until it ends or something goes wrong, as
   * `starl test` does. The files and options of the last call stay compiled, so that many trials of them cost little.
   */
  try(files: Files, options: TrialOptions, profile: string, seed: number | bigint | string): Tried;
  /** The scenario of such a run as a file for the folder of the scenario: it goes as the run goes. */
  profileScenario(files: Files, options: TrialOptions, profile: string, seed: number | bigint | string): string;
  /**
   * Makes such a run that goes wrong smaller: tries up to `most` scenarios, 1,000 by default. Another call about the
   * same run, with a greater `most`, goes on from where the last one ended. Throws a StarlError if nothing goes wrong.
   */
  shrink(
    files: Files,
    options: TrialOptions,
    profile: string,
    seed: number | bigint | string,
    limits?: { most?: number },
  ): Shrunk;
  /** Opens a scenario with its programs. Throws a StarlError with diagnostics if something is wrong with them. */
  open(files: Files, options?: Options): Simulation;
  /**
   * Opens the run that a trace records, at its start; it is steered as it was. Throws a StarlError if the trace does
   * not hold what that takes.
   */
  openRecorded(recorded: Recorded, options?: Pick<Options, "topics">): Simulation;
  /**
   * Answers a request of the JSON service (apps/starl-catalog/src/service/request.rs), such as
   * `{ report: { simulation: 0 } }`. The methods of this class and of Simulation are made of such requests.
   */
  request(request: object): unknown;
}

/** What a trace holds of how its run was started and steered: docs/reference/trace.md. */
export interface Recorded {
  /** The attachment `starl/scenario.toml`. */
  scenario: string;
  /** The attachments `starl/files/NAME`, by name. */
  files: Record<string, string>;
  /** When the run was steered, nanoseconds, and how: the records on `/starl/intervention`. */
  interventions: [number, Intervention][];
}

/** An example that comes with StarL. */
export interface Example {
  name: string;
  /** What one sees, in one line. */
  summary: string;
  /** The path of its scenario in `files`. */
  scenario: string;
  files: Record<string, string>;
}

/** What to open, and what to change of it. Each stands for an option of `starl run`. */
export interface Options {
  /**
   * The path of a scenario among the files, or an example's name. By default the only scenario among the files; if
   * there is none, an empty floor with a few robots.
   */
  scenario?: string;
  /**
   * The path of a program, or the name of one in Rust, instead of the scenario's. If there is no scenario, by
   * default the only program among the files.
   */
  program?: string;
  /** Another seed. Seeds have 64 bits: give large ones as bigint or text. */
  seed?: number | bigint | string;
  /** Another duration, such as `"30s"`. */
  duration?: string;
  /** Another fleet, such as `"create=2,drone=2"`. */
  robots?: string;
  /** Fields of the scenario to set, such as `"network.loss=0.2"`. */
  set?: string[];
  /** The path of a file with faults to add. */
  faults?: string;
  /** Keep the records of these topics only, such as `"/starl/action"`. All by default. */
  topics?: Iterable<string>;
}

export type TrialOptions = Omit<Options, "topics">;

/** A profile of faults: docs/reference/testing.md. */
export interface Profile {
  name: string;
  /** The faults, in one line. */
  summary: string;
  /** Whether `starl test` tries it unless others are named. */
  usual: boolean;
  /** Whether a run that does not reach its goal is held to be wrong. */
  demands_goal: boolean;
}

/** What came of a run that ended, or was ended by what went wrong. */
export interface Tried {
  profile: string;
  /** The seed of 64 bits, as text. */
  seed: string;
  outcome: Outcome;
  /** The property that was violated, `failed` or `unreached`; null where nothing is wrong. */
  wrong: string | null;
  /** What was seen, in a sentence; empty where nothing is wrong. */
  text: string;
  /** When the run ended. */
  now: number;
  digest: string;
  progress: Report["progress"];
  messages: Report["messages"];
  collisions: number;
  violations: Report["violations"];
  failures: Report["failures"];
}

/** The smallest scenario that was found to fail in the same way. */
export interface Shrunk {
  /** Its file, for the folder of the scenario that was tried. */
  scenario: string;
  /** What comes of it; its seed may be another one. */
  tried: Tried;
  /** How many scenarios were tried. */
  trials: number;
  /** Whether no robot, fault or network trouble can be left out; otherwise `most` came first. */
  minimal: boolean;
  before: Extent;
  after: Extent;
}

/** How large a scenario is. */
export interface Extent {
  robots: number;
  faults: number;
  duration_seconds: number;
}

/** One problem of a file. */
export interface Diagnostic {
  /** The file's path; null for a problem with an option. */
  file: string | null;
  /** From 1. */
  line: number;
  /** From 1, in Unicode characters (code points). */
  column: number;
  end_line: number;
  /** The character after the last. */
  end_column: number;
  /** In Unicode characters; 0 if only the start is known. */
  length: number;
  severity: "error" | "warning";
  /** The number in the reference of errors; null for scenarios. */
  code: string | null;
  /** The field of a scenario, such as `network.loss`, or the option. */
  field: string | null;
  message: string;
  /** A suggested fix. */
  help: string | null;
  /** More that is worth knowing, a line each. */
  notes: string[];
  /** Other places of the file that matter. */
  related: (FileRange & { message: string })[];
  /** The changes that the suggested fix makes to the file; empty where it is for people to make. */
  edits: (FileRange & { text: string })[];
  /** Whether the text could be taken away without a loss. */
  unnecessary: boolean;
}

/** A JSON Schema; properties are in the order of the reference. */
export interface Schema {
  [member: string]: unknown;
  description?: string;
  default?: unknown;
  properties?: Record<string, Schema>;
  required?: string[];
  /** What a field holds. */
  "x-kind"?:
    | "text"
    | "texts"
    | "flag"
    | "choice"
    | "model"
    | "count"
    | "probability"
    | "quantity"
    | "point"
    | "planar_point"
    | "outline"
    | "velocity"
    | "heights"
    | "robots"
    | "robot_groups"
    | "parameters"
    | "model_parameters"
    | "table"
    | "tables"
    | "switch";
  /** What a number measures. */
  "x-quantity"?:
    | "probability"
    | "duration"
    | "length"
    | "angle"
    | "speed"
    | "rate_of_turn"
    | "acceleration"
    | "mass"
    | "linear_drag"
    | "bit_rate"
    | "rate"
    | "ratio";
  /** In which units it may be written, from small to great. */
  "x-units"?: string[];
  /** The unit of the bounds; SI if there is none. */
  "x-unit"?: string;
  "x-minimum"?: number;
  "x-exclusive-minimum"?: number;
  "x-maximum"?: number;
  /** What holds where the field is left out, in words, if `default` does not say it. */
  "x-default"?: string;
}

/** A part of a file, counted as in a Diagnostic. */
export interface FileRange {
  line: number;
  column: number;
  end_line: number;
  end_column: number;
}

/** A place between two characters, as the Language Server Protocol counts: both numbers from 0. */
export interface Position {
  line: number;
  /** In UTF-16 units, as the indices of strings in JavaScript. */
  character: number;
}

/** The end is excluded. */
export interface Range {
  start: Position;
  end: Position;
}

export interface Hover {
  /** The name that it is about. */
  range: Range;
  markdown: string;
}

export interface Completion {
  label: string;
  kind: CompletionKind;
  /** How it is declared. */
  detail: string | null;
  /** In Markdown. */
  documentation: string | null;
  /** What to put instead of `range`. */
  insert: string;
  /** Where the cursor belongs in `insert`: so many UTF-16 units stand before it. */
  cursor: number;
  /** What it replaces: the word that is being typed. */
  range: Range;
}

export type CompletionKind =
  | "class"
  | "constant"
  | "enum"
  | "enum_member"
  | "event"
  | "field"
  | "function"
  | "keyword"
  | "method"
  | "module"
  | "property"
  | "struct"
  | "variable";

export interface Definition {
  /** One of the files; or, as `starl-library:/geometry.starl`, a text that is part of the language. */
  path: string;
  /** The name there. */
  range: Range;
  /** The text of what is part of the language; null for one of the files. */
  text: string | null;
}

export interface OutlinePart {
  name: string;
  kind:
    | "enum"
    | "variant"
    | "record"
    | "field"
    | "message"
    | "parameter"
    | "constant"
    | "variable"
    | "primitive"
    | "function"
    | "action"
    | "handler"
    | "role"
    | "property";
  /** More that is worth seeing, such as its type. */
  detail: string | null;
  /** All of it, without the comments above. */
  range: Range;
  name_range: Range;
  parts: OutlinePart[];
}

/** How far a run is. */
export interface Status {
  now: number;
  /** Whether the run has come to its end. */
  over: boolean;
  /** Null before the end. */
  outcome: Outcome | null;
  /** How many physics steps the call has made. */
  steps: number;
  /** The breakpoint that was met in the last of these steps; null if none was. */
  stopped: Stopped | null;
}

/** Where a run stops. A robot that is absent or null is any robot. */
export type Breakpoint =
  /** An action fires; one of a role is called `role.name`. */
  | { action: { name: string; robot?: number | null } }
  /**
   * A datagram is delivered: any, or one that carries this message. A message is known if it comes by Unicast, by
   * Geocast, or by Broadcast but in total order, and the receiver's program, in the StarL language, handles it.
   */
  | { message: { name?: string | null; robot?: number | null } }
  /**
   * A Bool of the StarL language becomes true, as in a property: of a robot if it has no quantifier, else of the robots
   * that run the program. One that is true already has to become false first.
   */
  | { when: { expression: string } };

/** Why a run has stopped. */
export interface Stopped {
  /** Which breakpoint, by its place in the list. */
  breakpoint: number;
  /** When that happened. */
  at: number;
  /** On which robot; null if it is about the fleet. */
  robot: number | null;
  /** What happened, in one line. */
  text: string;
}

export type Outcome = "reached" | "violated" | "timed_out" | "failed";

/** One simulation. Its methods throw a StarlError after `close()`. */
export class Simulation {
  private constructor();
  readonly title: string;
  /** The seed of 64 bits, as text. */
  readonly seed: string;
  /** When the run ends at the latest. */
  readonly duration: number;
  /** The length of a physics step. */
  readonly step_length: number;
  /** The warnings of the compiler. */
  readonly warnings: Diagnostic[];

  /** Frees its memory and that of its snapshots. */
  close(): void;
  status(): Status;
  /** Makes one physics step, also when the run is over. */
  step(): Status;
  /**
   * Makes physics steps until the run is over, the time `until` has come, `steps` are made, or a breakpoint is met; to
   * the end if none of these is given. With a period `sample` in seconds of simulated time, it keeps a frame after each step that
   * reaches or passes a multiple of the period: see `frames()`.
   */
  run(budget?: { until?: number; steps?: number; sample?: number }): Status;
  /**
   * Replaces the breakpoints: `run` stops after the step in which one is met, and `step` says so. They make no
   * difference to the run, and stay when it goes back to a snapshot. Throws a StarlError if one makes no sense; then
   * those that there were stay. Problems of an expression are its diagnostics: their places are in the expression, and
   * their field is `breakpoints.0.when.expression`, with the place in the list.
   */
  breakpoints(breakpoints: Breakpoint[]): void;
  /**
   * Steers the run: at the time `at`, or at once if that is not given or has passed. Throws a StarlError that says
   * what is wrong with the intervention.
   */
  apply(intervention: Intervention, when?: { at?: number }): void;
  /** Keeps the present moment, records and frames that were not taken included. */
  snapshot(): number;
  /** Goes back, or forth, to a moment that was kept, exactly. It stays kept. */
  restore(snapshot: number): Status;
  /** Forgets a moment that was kept. */
  drop(snapshot: number): void;
  /** The scenario as a file, with all that was applied: run from the start, it goes as this run went. */
  scenario(): string;
  /**
   * The run up to the present moment as a trace, an MCAP file: docs/reference/trace.md. The run is made again for it,
   * which takes as long.
   */
  trace(): Uint8Array;
  /** Takes up to `max` records, the oldest first; all if `max` is not given. */
  records(max?: number): Batch;
  world(): World;
  /** All robots in the order of their numbers, those that have joined and left too. */
  fleet(): Member[];
  /**
   * Where the program of each robot is, in the order of their numbers, for a label beside its name: the value of the
   * first variable of an enum of a program in the StarL language, such as `wait`, or its role. Null where there is no
   * such variable, for programs in Rust, and before the program has started.
   */
  states(): (string | null)[];
  /**
   * The values of shared variables in records since the last call: records hold hashes of them. Values of linearizable
   * variables and of programs in Rust are not among them, nor those that could be of several types.
   */
  values(): SharedValue[];
  /** All there is to see of a robot now. */
  robot(robot: number): Robot;
  /** What has come of the run so far. */
  report(): Report;
  /**
   * POSE_NUMBERS numbers for each robot in the order of their numbers: the true x, y, z, yaw, pitch and roll; x, y,
   * z and yaw as the robot believes them; and its condition, 0 running, 1 finished, 2 failed, 3 down, 4 left. The
   * array lies in the memory of the module: it is good until the next call of any method. Copy it to keep it.
   */
  poses(): Float64Array;
  /**
   * Takes the frames that `run` has kept since the last call, the oldest first. Each is its time in seconds, the
   * number of robots n, and n times POSE_NUMBERS numbers as in `poses()`. No more than 20,000,000 numbers are kept
   * until they are taken; then the oldest frames are dropped. The array is good until the next call of any method.
   */
  frames(): Float64Array;
}

/** Records that were taken. */
export interface Batch {
  records: TraceRecord[];
  /** How many more there are to be taken. */
  left: number;
  /** How many were dropped since the last call: more than 200,000 are not kept. */
  dropped: number;
}

/** A value of a shared variable: the variable, the hash in records, and the value as text. */
export type SharedValue = [variable: string, hash: number, value: string];

/** A record as it stands in a trace: docs/reference/trace.md. */
export interface TraceRecord {
  /** Nanoseconds. */
  time_ns: number;
  /** Such as `/starl/action`. */
  topic: string;
  /** Its members depend on the topic; `robot` is absent where something happened to the world as a whole. */
  message: { robot?: number; [member: string]: unknown };
}

export interface Point {
  x: number;
  y: number;
  z: number;
}

export interface Pose {
  /** The centre of the body's base. */
  position: Point;
  /** Heading from the x axis, left positive. */
  yaw: number;
  /** Nose-down angle. */
  pitch: number;
  /** Right-side-down angle. */
  roll: number;
}

/** Rates of change of a pose, world frame. */
export interface Twist {
  linear: Point;
  yaw: number;
  pitch: number;
  roll: number;
}

/** Null is from the floor to the sky. */
export type HeightSpan = { low: number; high: number } | null;

export type Obstacle =
  | { Polygon: { base: Point[]; height: HeightSpan } }
  | { Circle: { center: Point; radius: number; height: HeightSpan } }
  | { Cuboid: { low: Point; high: Point } };

export interface WayPoint {
  name: string;
  position: Point;
  /** 0 where none is given. */
  group: number;
}

export interface World {
  /** Those that stand, the walls around the world included; `index` is that of interventions. */
  obstacles: { index: number; obstacle: Obstacle; hidden: boolean }[];
  way_points: WayPoint[];
  things: { index: number; name: string; position: Point; holder: number | null }[];
}

export type Condition = "running" | "finished" | "failed" | "down" | "left";

export interface Member {
  id: number;
  name: string;
  model: string;
  /** The program that it runs, as the scenario names it. */
  program: string;
  /** Of its body. */
  radius: number;
  height: number;
  flies: boolean;
  condition: Condition;
}

/** Readings of sensors: lengths in metres, bearings in radians from the robot's heading, left positive. */
export interface Sensors {
  /** The bearing of what touches the bumper; null if nothing does, or without a bumper. */
  bumper: number | null;
  /** How far the proximity sensor's rays reach beyond the body's edge; null without that sensor. */
  proximity_range: number | null;
  /** `distance` is from the body's edge to what the ray meets; the range if it meets nothing. */
  proximity: { bearing: number; distance: number }[];
  /** How far the detector sees from the robot's centre; null without a detector. */
  detector_range: number | null;
  /** The things and robots that the detector sees, the nearest first. */
  detections: { name: string; position: Point }[];
}

/** One robot at one moment. */
export interface Robot {
  id: number;
  name: string;
  model: string;
  program: string;
  condition: Condition;
  /** Whether its software has started in its present life. */
  started: boolean;
  /** Why its program cannot continue. */
  failure: string | null;
  motors_stuck: boolean;
  sensors_frozen: boolean;
  /** What its program would read if it ran now; nothing while it does not run. */
  sensors: Sensors;
  pose: Pose;
  twist: Twist;
  /** What it believes; `at` is in nanoseconds of its own clock. */
  estimate: { pose: Pose; twist: Twist; at: number };
  /** What its model is told to do. */
  command: unknown;
  /** The name of the thing in its gripper. */
  holding: string | null;
  /** How far it has come along its path. */
  distance: number;
  way_points_reached: number;
  /** What its own clock shows; how far it was ahead at the start; seconds that it counts in a simulated second. */
  clock: { now: number; offset: number; rate: number };
  /** Null if its program does not run. */
  next_activation: number | null;
  /** The next one first. */
  timers: {
    /** The primitive that armed it, by its name in the program, or `program`; null if that is not known. */
    owner: string | null;
    port: number;
    kind: number;
    number: number;
    /** By the robot's own clock. */
    due: number;
    /** In simulated time. */
    due_simulated: number;
  }[];
  /** Datagrams on their way to it, the next one first; `at` is when it arrives. */
  mailbox: { from: number; sequence: number; to: string | null; port: number; at: number; bytes: number }[];
  /** Of a program in the StarL language: values are texts as programs write them. */
  variables: { name: string; type: string; value: string; parameter: boolean }[];
  /** Of a program in the StarL language: whether guards hold now. */
  actions: { name: string; enabled: boolean; error: string | null }[];
  /** Of a program in the StarL language; `state` is text for people. */
  primitives: { name: string; kind: string; port: number | null; state: string | null }[];
  /** All that a program in Rust goes by, as text for people; null if it does not show it. */
  state: string | null;
}

export interface Report {
  now: number;
  over: boolean;
  outcome: Outcome | null;
  /** The hash of all that has happened: 16 hexadecimal digits. */
  digest: string;
  progress: { robots: number; up: number; finished: number; failed: number };
  /** Counts of datagrams. */
  messages: { sent: number; delivered: number; lost: number; dropped: number; retransmitted: number };
  /** How often bodies have come to touch. */
  collisions: number;
  /** The network as it is now: the positions of all knobs. */
  network: NetworkKnob[];
  properties: {
    property: string;
    verdict: "holds" | "violated" | "open" | "unused";
    violations: number;
    /** How often something that speaks against it was excused, by reason. */
    excused: { reason: string; count: number }[];
  }[];
  violations: { property: string; at: number; robots: number[]; text: string }[];
  failures: { at: number; robot: number; text: string }[];
}

/** Something that steers a run from outside. Robots are numbers. */
export type Intervention =
  | { fault: Fault }
  /** Moves a body as far as nothing is in the way. */
  | { push: { robot: number; by: Point } }
  | { network: NetworkKnob[] }
  | { add_obstacle: { obstacle: Obstacle; hidden: boolean } }
  | { move_obstacle: { index: number; obstacle: Obstacle } }
  | { remove_obstacle: { index: number } }
  | { set_way_point: WayPoint }
  | { remove_way_point: { name: string } }
  | { set_thing: { name: string; position: Point } }
  | { remove_thing: { name: string } }
  /** An operator tells robots something; all of them if `robots` is empty. */
  | { tell: { robots: number[]; order: { name: string; fields: unknown } } }
  /** A robot of the kind of another joins, and gets the next free number. */
  | { join: { like: number; name: string; pose: Pose } }
  | { leave: number[] };

export type Fault =
  | { crash: number[] }
  | { restart: number[] }
  /** Robots in different groups do not hear each other; robots in no group form one more. */
  | { partition: number[][] }
  /** The same, but that robots of a group hear those before it and those in no group. */
  | { one_way: number[][] }
  | "heal"
  | { stuck_motor: number[] }
  | { frozen_sensor: number[] }
  | { repair: number[] }
  | { corrupt_state: number[] };

/** Delays are in nanoseconds. */
export type NetworkKnob =
  | { delay: number }
  | { jitter: number }
  | { distribution: "constant" | "uniform" | "normal" | "exponential" }
  | { loss: number }
  | { duplication: number }
  | { reordering: number }
  | { reordering_delay: number }
  /** Metres; null is everywhere. */
  | { range: number | null }
  | { line_of_sight: boolean }
  /** Bits per second; null is anything. */
  | { bandwidth: number | null }
  | { queue: number }
  /** Bytes. */
  | { largest: number };
