// Names beside what they name. One that would cover another is left out; those that were shown stay, so that nothing
// flickers.

import { POSE_NUMBERS } from "../../engine/types.ts";
import { hovered } from "../pick.ts";
import type { Scene } from "../scene.ts";
import { LEFT } from "../scene.ts";
import type { View } from "../view.ts";
import { BOLD, PLAIN, Texts } from "./texts.ts";

/** Labels have room of their own in cells of so many pixels. */
const CELL = 6;
/** More robots or waypoints get no names. */
const [MOST_ROBOTS, MOST_PLACES] = [90, 30];
const CONDITIONS = ["", "finished", "failed", "down", "left"];

export class Labels {
  #cells = new Uint8Array();
  #columns = 0;
  #rows = 0;
  #names = new Texts(BOLD);
  #quiet = new Texts(PLAIN);
  #alarming = new Texts(PLAIN);
  #placeNames = new Texts(PLAIN);
  #shown: number[] = [];
  #at = new Float32Array(3);

  /** `ratio` is how many pixels of the screen are in a CSS pixel. */
  draw(
    context: CanvasRenderingContext2D,
    scene: Scene,
    view: View,
    screen: Float32Array,
    ratio: number,
  ): void {
    this.#clear(view);
    const { css } = scene.palette;
    this.#names.use(ratio, css.text, css.floor);
    this.#quiet.use(ratio, css.muted, css.floor);
    this.#alarming.use(ratio, css.violation, css.floor);
    this.#placeNames.use(ratio, css["way-point"], css.floor);
    this.#robots(context, scene, screen);
    if (!scene.hidden.has("marks")) this.#marks(context, scene, view);
    if (!scene.hidden.has("wayPoints")) this.#places(context, scene, view);
    if (!scene.hidden.has("things")) this.#things(context, scene, view);
  }

  #robots(context: CanvasRenderingContext2D, scene: Scene, screen: Float32Array): void {
    const chosen = [...scene.selected];
    if (hovered.value?.kind === "robot") chosen.push(hovered.value.robot);
    const shown: number[] = [];
    const seen = new Set<number>();
    const name = (robot: number, always: boolean) => {
      if (seen.has(robot) || robot >= scene.count) return;
      seen.add(robot);
      if (this.#robot(context, scene, screen, robot, always)) shown.push(robot);
    };
    for (const robot of chosen.reverse()) name(robot, true);
    if (!scene.hidden.has("labels")) {
      for (const robot of this.#shown) if (shown.length < MOST_ROBOTS) name(robot, false);
      for (let robot = 0; robot < scene.count && shown.length < MOST_ROBOTS; robot++) name(robot, false);
    }
    this.#shown = shown;
  }

  #robot(
    context: CanvasRenderingContext2D,
    scene: Scene,
    screen: Float32Array,
    robot: number,
    always: boolean,
  ): boolean {
    const x = screen[robot * 3] ?? 0;
    const y = screen[robot * 3 + 1] ?? 0;
    const scale = screen[robot * 3 + 2] ?? 0;
    const condition = scene.poses[robot * POSE_NUMBERS + POSE_NUMBERS - 1] ?? LEFT;
    const member = scene.fleet[robot];
    if (scale === 0 || condition === LEFT || !member) return false;
    const state = CONDITIONS[condition] || (scene.states[robot] ?? "");
    const off = member.radius * scene.enlarged * scale + 6;
    let left = x + off * 0.75;
    const top = y - off * 0.75 - 6;
    // Most of a crowd end here, before they cost more.
    if (!always && !this.#isFree(left, top)) return false;
    const states = condition >= 2 ? this.#alarming : this.#quiet;
    const nameWidth = this.#names.width(context, member.name);
    const width = nameWidth + (state ? 5 + states.width(context, state) : 0);
    // At the right edge it stands on the other side.
    if (left + width > this.#columns * CELL) left = x - off * 0.75 - width;
    if (!this.#take(left - 2, top - 8, width + 4, 16, always)) return false;
    this.#names.draw(context, member.name, left, top);
    if (state) states.draw(context, state, left + nameWidth + 5, top);
    return true;
  }

  #marks(context: CanvasRenderingContext2D, scene: Scene, view: View): void {
    for (const { shape, label, points } of scene.happenings.marks.current.values()) {
      const place = points[0];
      if (shape !== "text" || !place) continue;
      view.project(place.x, place.y, place.z, this.#at);
      const [x = 0, y = 0, scale = 0] = this.#at;
      const width = this.#names.width(context, label);
      if (scale === 0 || !this.#take(x - width / 2, y - 8, width, 16, false)) continue;
      this.#names.draw(context, label, x - width / 2, y);
    }
  }

  #places(context: CanvasRenderingContext2D, scene: Scene, view: View): void {
    const points = scene.world.way_points;
    // Where there are many, a name keeps others away.
    const margin = points.length > 40 ? 60 : points.length > 16 ? 10 : 2;
    let left = MOST_PLACES;
    for (const { name, position } of points) {
      view.project(position.x, position.y, position.z, this.#at);
      const [x = 0, y = 0, scale = 0] = this.#at;
      const isHovered = hovered.value?.kind === "way_point" && hovered.value.name === name;
      if (scale === 0 || (!isHovered && (left <= 0 || scene.hidden.has("labels")))) continue;
      const width = this.#placeNames.width(context, name);
      const free = this.#take(x + 9 - margin, y + 1 - margin, width + 2 * margin, 14 + 2 * margin, isHovered);
      if (!free) continue;
      left--;
      this.#placeNames.draw(context, name, x + 9, y + 8);
    }
  }

  #things(context: CanvasRenderingContext2D, scene: Scene, view: View): void {
    for (const { name, position, holder } of scene.world.things) {
      const isHovered = hovered.value?.kind === "thing" && hovered.value.name === name;
      if (holder !== null || (scene.hidden.has("labels") && !isHovered)) continue;
      view.project(position.x, position.y, position.z, this.#at);
      const [x = 0, y = 0, scale = 0] = this.#at;
      const width = this.#quiet.width(context, name);
      if (scale === 0 || !this.#take(x + 10, y - 22, width, 16, isHovered)) continue;
      this.#quiet.draw(context, name, x + 10, y - 14);
    }
  }

  #clear({ width, height }: View): void {
    this.#columns = Math.ceil(width / CELL);
    this.#rows = Math.ceil(height / CELL);
    const cells = this.#columns * this.#rows;
    if (this.#cells.length === cells) this.#cells.fill(0);
    else this.#cells = new Uint8Array(cells);
  }

  #isFree(x: number, y: number): boolean {
    const [column, row] = [Math.floor(x / CELL), Math.floor(y / CELL)];
    const inside = column >= 0 && row >= 0 && column < this.#columns && row < this.#rows;
    return inside && !this.#cells[row * this.#columns + column];
  }

  /** Takes a place on the screen, unless it is taken or off the screen. */
  #take(left: number, top: number, width: number, height: number, always: boolean): boolean {
    const [from, to] = [Math.floor(left / CELL), Math.floor((left + width) / CELL)];
    const [first, last] = [Math.floor(top / CELL), Math.floor((top + height) / CELL)];
    if (to < 0 || last < 0 || from >= this.#columns || first >= this.#rows) return false;
    const [start, end] = [Math.max(0, from), Math.min(this.#columns - 1, to)];
    const [above, below] = [Math.max(0, first), Math.min(this.#rows - 1, last)];
    if (!always) {
      for (let row = above; row <= below; row++) {
        for (let column = start; column <= end; column++)
          if (this.#cells[row * this.#columns + column]) return false;
      }
    }
    for (let row = above; row <= below; row++) {
      this.#cells.fill(1, row * this.#columns + start, row * this.#columns + end + 1);
    }
    return true;
  }
}
