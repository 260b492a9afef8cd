// The view of the world on the page: makes a picture when something has changed, and never otherwise.

import { effect } from "@preact/signals";
import { expectsRun, run } from "../app/context.ts";
import { theme } from "../app/theme.ts";
import { POSE_NUMBERS } from "../engine/types.ts";
import { movingBox, wholeBox } from "./fit.ts";
import { Flat } from "./flat.ts";
import { Hand, type Screen } from "./hand.ts";
import { Happenings } from "./happenings.ts";
import { flat, hidden } from "./layers.ts";
import { Overlay } from "./overlay/overlay.ts";
import { readPalette, robotColors } from "./palette.ts";
import { followed, hovered, measured, moving, pointed, tool } from "./pick.ts";
import { rangeOf } from "./range.ts";
import type { Painter, Scene } from "./scene.ts";
import { type Box, View } from "./view.ts";

/** The interval at which an unchanged view checks whether it still shows everything, ms. */
const LOOK_EVERY = 400;
/** How long what has just happened stays visible, s of real time at normal speed. */
const LINGER = 0.45;

export class WorldScreen implements Screen {
  readonly view = new View();
  readonly scene: Scene;
  readonly overlay: Overlay;
  #painter: Painter | null = null;
  #canvas: HTMLCanvasElement | null = null;
  #hand: Hand;
  #upper: HTMLCanvasElement;
  #ratio = 1;
  #requested = 0;
  /** Whether the view follows moving robots, because no person has changed it. */
  #free = true;
  #lookedAt = 0;
  #opened: unknown = null;
  #stops: (() => void)[] = [];
  #disposed = false;
  #loading = false;

  /** `onFlat` is called when there is no WebGL, so that the world can be shown from above only. */
  constructor(
    private readonly element: HTMLElement,
    private readonly onFlat: (isFlat: boolean) => void,
  ) {
    this.#upper = document.createElement("canvas");
    element.append(this.#upper);
    const context = this.#upper.getContext("2d");
    if (!context) throw new Error("this browser draws no canvas");
    this.overlay = new Overlay(context, this.view);
    this.scene = emptyScene(element);
    this.#hand = new Hand(element, this);
    const observer = new ResizeObserver(() => this.#resize());
    observer.observe(element);
    this.#stops.push(
      () => observer.disconnect(),
      effect(() => this.#changed()),
      effect(() => this.#look()),
      effect(() => {
        if (expectsRun.value || run.opening.value || run.opened.value) void this.#load();
      }),
    );
  }

  dispose(): void {
    this.#disposed = true;
    cancelAnimationFrame(this.#requested);
    for (const stop of this.#stops) stop();
    this.#hand.dispose();
    this.#painter?.dispose();
    this.#canvas?.remove();
    this.#upper.remove();
  }

  /** Shows what moves, or everything. */
  fit(whole = false): void {
    const box = this.#box(whole);
    if (box) this.view.fit(box);
    this.#free = !whole;
    followed.value = null;
    this.request();
  }

  /** The view was changed by hand. */
  taken(moved: boolean): void {
    this.#free = false;
    if (moved) followed.value = null;
    this.request();
  }

  request(): void {
    this.#requested ||= requestAnimationFrame(() => {
      this.#requested = 0;
      this.#draw();
    });
  }

  /** The painter is large, so it is loaded with the first run. */
  async #load(): Promise<void> {
    if (this.#loading) return;
    this.#loading = true;
    try {
      const { Stage } = await import("./three/stage.ts");
      if (this.#disposed) return;
      const canvas = this.#lower();
      canvas.addEventListener("webglcontextlost", (event) => {
        event.preventDefault();
        this.#use(new Flat(this.#lower()), true);
      });
      this.#use(new Stage(canvas, () => this.request()), false);
    } catch {
      if (!this.#disposed) this.#use(new Flat(this.#lower()), true);
    }
  }

  /** A fresh canvas: one that had WebGL draws nothing else. */
  #lower(): HTMLCanvasElement {
    this.#painter?.dispose();
    this.#painter = null;
    this.#canvas?.remove();
    this.#canvas = document.createElement("canvas");
    this.element.prepend(this.#canvas);
    return this.#canvas;
  }

  #use(painter: Painter, isFlat: boolean): void {
    this.#painter = painter;
    this.onFlat(isFlat);
    if (isFlat) flat.value = true;
    this.#resize();
  }

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.#ratio = Math.min(2, devicePixelRatio || 1);
    [this.view.width, this.view.height] = [width, height];
    this.#upper.width = Math.round(width * this.#ratio);
    this.#upper.height = Math.round(height * this.#ratio);
    this.#painter?.resize(width, height, this.#ratio);
    if (this.#free) this.#refit(true);
    this.request();
  }

  /** Takes over what the page knows now. */
  #changed(): void {
    const { scene } = this;
    const poses = run.poses.value;
    scene.now = run.now.value;
    scene.poses = poses;
    scene.count = Math.floor(poses.length / POSE_NUMBERS);
    scene.fleet = run.fleet.value;
    scene.states = run.states.value;
    scene.world = run.world.value;
    scene.selected = run.selected.value;
    scene.robots = run.robots.value;
    scene.message = run.message.value;
    scene.linger = Math.min(5, Math.max(0.02, LINGER * run.speed.value));
    scene.hidden = hidden.value;
    void [run.grown.value, hovered.value, measured.value, moving.value, tool.value];
    if (tool.value === "measure" && measured.value.length === 1) void pointed.value;
    scene.happenings.go(run.events, run.position.value);
    scene.range = rangeOf(scene.happenings);
    if (run.opened.value !== this.#opened) this.#open(run.opened.value);
    this.#follow();
    this.request();
  }

  /** Another run: nothing of the one before is shown. */
  #open(opened: unknown): void {
    this.#opened = opened;
    this.scene.happenings = new Happenings();
    this.#free = true;
    this.#lookedAt = 0;
    followed.value = null;
    measured.value = [];
    hovered.value = null;
  }

  #look(): void {
    const { scene, view } = this;
    const dark = theme.value === "dark";
    if (scene.palette.dark !== dark || scene.colors.css.length !== run.fleet.value.length) {
      scene.palette = readPalette(this.element, dark);
      scene.colors = robotColors(run.fleet.value.length, dark);
    }
    if (view.flat !== flat.value) {
      view.setFlat(flat.value);
      if (this.#free) this.#refit(true);
    }
    this.request();
  }

  #follow(): void {
    const robot = followed.value;
    const at = (robot ?? 0) * POSE_NUMBERS;
    if (robot === null || at >= this.scene.poses.length) return;
    this.#free = false;
    const [x = 0, y = 0, z = 0] = this.scene.poses.subarray(at, at + 3);
    Object.assign(this.view.target, { x, y, z });
  }

  #box(whole: boolean): Box | null {
    const { poses, history, now, world } = this.scene;
    return whole ? wholeBox(poses, world) : movingBox(poses, history, now, world);
  }

  #refit(always: boolean): void {
    const box = this.#box(false);
    if (box && (always || !this.view.holds(box))) this.view.fit(box);
  }

  #draw(): void {
    const { scene, view } = this;
    if (this.#disposed || !this.#painter || this.element.clientWidth === 0) return;
    const time = performance.now();
    if (this.#free && scene.count > 0 && time - this.#lookedAt > LOOK_EVERY) {
      this.#refit(this.#lookedAt === 0);
      this.#lookedAt = time;
    }
    scene.enlarged = enlargement(scene, view);
    scene.sky = skyOf(scene);
    this.#painter.paint(scene, view);
    this.overlay.draw(scene, this.#ratio);
  }
}

/** How much larger robots are drawn than they are, so that they can be seen, px. */
function enlargement({ count, fleet }: Scene, view: View): number {
  const seen = count <= 60 ? 17 : count <= 300 ? 11 : 6;
  const radius = fleet[0]?.radius ?? 0.15;
  return Math.max(1, (seen * view.pixel) / (2 * radius));
}

/** Unbounded obstacles are drawn slightly higher than robots on the floor, and low enough not to hide them. */
function skyOf({ fleet, enlarged }: Scene): number {
  const tallest = fleet.reduce((most, { height, flies }) => Math.max(most, flies ? 0 : height), 0.1);
  return Math.min(2, tallest * 2.2 * Math.min(3, enlarged));
}

function emptyScene(element: Element): Scene {
  const dark = theme.value === "dark";
  return {
    now: 0,
    poses: new Float32Array(),
    count: 0,
    fleet: [],
    states: [],
    world: { obstacles: [], way_points: [], things: [] },
    history: run.history,
    happenings: new Happenings(),
    selected: [],
    robots: [],
    message: null,
    linger: LINGER,
    hidden: hidden.value,
    palette: readPalette(element, dark),
    colors: robotColors(0, dark),
    sky: 0.3,
    range: null,
    enlarged: 1,
  };
}
