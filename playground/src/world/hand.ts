// The tools of a person in the world: select, measure, move.

import { run } from "../app/context.ts";
import { EngineError } from "../engine/client.ts";
import type { Point } from "../engine/types.ts";
import { Controls, type Listener } from "./controls.ts";
import { find } from "./find.ts";
import { movedBy, placeOf } from "./move.ts";
import type { Overlay } from "./overlay/overlay.ts";
import {
  clicked,
  followed,
  hovered,
  measured,
  moving,
  pointed,
  sameTarget,
  type Target,
  tool,
} from "./pick.ts";
import type { Scene } from "./scene.ts";
import type { View } from "./view.ts";

/** The screen that a hand works on. */
export interface Screen {
  readonly view: View;
  readonly scene: Scene;
  readonly overlay: Overlay;
  /** Shows what moves, or everything. */
  fit(whole: boolean): void;
  /** The view was changed by hand. */
  taken(moved: boolean): void;
}

export class Hand implements Listener {
  #controls: Controls;
  /** The dragged item, and the place on its floor at which it was taken. */
  #dragged: { target: Target; from: Point; at: { x: number; y: number } } | null = null;

  constructor(
    private readonly element: HTMLElement,
    private readonly screen: Screen,
  ) {
    this.#controls = new Controls(element, screen.view, this);
  }

  dispose(): void {
    this.#controls.dispose();
    hovered.value = null;
    pointed.value = null;
  }

  changed(moved: boolean): void {
    this.screen.taken(moved);
  }

  hover(x: number, y: number): void {
    const target = this.#find(x, y);
    if (!sameTarget(target, hovered.value)) hovered.value = target;
    pointed.value = this.screen.view.floorAt(x, y);
    const takes = tool.value === "move" ? target !== null : target?.kind === "robot" && tool.value === "look";
    const cursor =
      tool.value === "measure" ? "crosshair" : takes ? (tool.value === "move" ? "move" : "pointer") : "";
    this.element.style.cursor = cursor;
  }

  leave(): void {
    hovered.value = null;
    pointed.value = null;
  }

  click(x: number, y: number, shift: boolean): void {
    const target = this.#find(x, y);
    const floor = this.screen.view.floorAt(x, y);
    if (floor) clicked.value = { at: floor, on: target, shift };
    if (tool.value === "measure") this.#measure(target, floor);
    else if (tool.value === "look" || tool.value === "move") select(target, shift);
  }

  grab(x: number, y: number): boolean {
    if (tool.value !== "move" || !run.live.value) return false;
    const target = this.#find(x, y);
    const from = target && placeOf(target, this.screen.scene);
    const at = from && this.screen.view.floorAt(x, y, from.z);
    if (!target || !from || !at) return false;
    // An obstacle is taken where the pointer is.
    this.#dragged = { target, from: target.kind === "obstacle" ? { ...at, z: 0 } : from, at };
    return true;
  }

  drag(x: number, y: number): void {
    const dragged = this.#dragged;
    const at = dragged && this.screen.view.floorAt(x, y, dragged.from.z);
    if (!at) return;
    const { from, target } = dragged;
    const to = { x: from.x + at.x - dragged.at.x, y: from.y + at.y - dragged.at.y, z: from.z };
    moving.value = { target, from, to };
  }

  drop(x: number, y: number): void {
    this.drag(x, y);
    const move = moving.value;
    this.cancel();
    if (!move) return;
    const by = { x: move.to.x - move.from.x, y: move.to.y - move.from.y };
    const intervention = movedBy(move.target, by, this.screen.scene);
    if (!intervention) return;
    run.applyAndShow(intervention).catch((error: Error) => {
      run.problem.value = error instanceof EngineError ? error : new EngineError(error.message);
    });
  }

  cancel(): void {
    this.#dragged = null;
    moving.value = null;
  }

  key(key: string, shift: boolean): boolean {
    if (key === "f" || key === "F") this.screen.fit(shift);
    else if (key === "Escape" && (moving.value || measured.value.length > 0)) {
      this.cancel();
      measured.value = [];
    } else if (key === "Escape" && tool.value !== "look") tool.value = "look";
    else if (key === "Escape" && run.selected.value.length > 0) run.select([]);
    else return false;
    return true;
  }

  #find(x: number, y: number): Target | null {
    return find(x, y, this.screen.scene, this.screen.view, this.screen.overlay.screen);
  }

  /** From the middle of what is clicked, or from the floor. */
  #measure(target: Target | null, floor: { x: number; y: number } | null): void {
    const middle = target && target.kind !== "obstacle" ? placeOf(target, this.screen.scene) : null;
    const point = middle ?? (floor && { ...floor, z: 0 });
    if (!point) return;
    measured.value = measured.value.length === 1 ? [...measured.value, point] : [point];
  }
}

function select(target: Target | null, shift: boolean): void {
  const before = run.selected.value;
  if (target?.kind !== "robot") {
    if (!shift && before.length > 0) run.select([]);
    return;
  }
  const { robot } = target;
  if (!shift) run.select([robot]);
  else run.select(before.includes(robot) ? before.filter((other) => other !== robot) : [...before, robot]);
  if (followed.value !== null && run.selected.value.includes(robot)) followed.value = robot;
}
