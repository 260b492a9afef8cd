// Mouse, wheel, fingers and keys. Seen from above, dragging moves the world; in 3-D it turns it, and the right button,
// the shift key or two fingers move it.

import type { View } from "./view.ts";

/** A press that moves less than this is a click, px. */
const STILL = 5;
const TURN = 0.006;
const STEP = 50;

export interface Listener {
  /** The view has changed by hand. */
  changed(moved: boolean): void;
  hover(x: number, y: number): void;
  leave(): void;
  click(x: number, y: number, shift: boolean): void;
  /** Whether a drag that begins here belongs to a tool rather than to the view. */
  grab(x: number, y: number): boolean;
  drag(x: number, y: number): void;
  drop(x: number, y: number): void;
  /** A drag of a tool was broken off. */
  cancel(): void;
  key(key: string, shift: boolean): boolean;
}

interface Finger {
  x: number;
  y: number;
}

export class Controls {
  #fingers = new Map<number, Finger>();
  #moved = 0;
  #grabbed = false;
  #stop = new AbortController();

  constructor(
    private readonly element: HTMLElement,
    private readonly view: View,
    private readonly listener: Listener,
  ) {
    const on = <Name extends keyof HTMLElementEventMap>(
      name: Name,
      act: (event: HTMLElementEventMap[Name]) => void,
    ) => element.addEventListener(name, act, { signal: this.#stop.signal, passive: false });
    on("pointerdown", (event) => this.#down(event));
    on("pointermove", (event) => this.#move(event));
    on("pointerup", (event) => this.#up(event));
    on("pointercancel", (event) => this.#cancel(event));
    on("pointerleave", () => listener.leave());
    on("wheel", (event) => this.#wheel(event));
    on("contextmenu", (event) => event.preventDefault());
    on("keydown", (event) => this.#key(event));
  }

  dispose(): void {
    this.#stop.abort();
  }

  #at(event: MouseEvent): Finger {
    const box = this.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #down(event: PointerEvent): void {
    this.element.setPointerCapture(event.pointerId);
    const at = this.#at(event);
    this.#fingers.set(event.pointerId, at);
    if (this.#fingers.size === 1) {
      this.#moved = 0;
      this.#grabbed = event.button === 0 && this.listener.grab(at.x, at.y);
    } else {
      this.#moved = STILL;
      if (this.#grabbed) this.listener.cancel();
      this.#grabbed = false;
    }
  }

  #move(event: PointerEvent): void {
    const at = this.#at(event);
    const before = this.#fingers.get(event.pointerId);
    if (before) this.#drag(event, before, at);
    else this.listener.hover(at.x, at.y);
  }

  #drag(event: PointerEvent, before: Finger, at: Finger): void {
    const [dx, dy] = [at.x - before.x, at.y - before.y];
    this.#moved += Math.hypot(dx, dy);
    if (this.#fingers.size === 1 && this.#moved < STILL) return;
    const others = [...this.#fingers].filter(([id]) => id !== event.pointerId).map(([, finger]) => finger);
    this.#fingers.set(event.pointerId, at);
    const [other] = others;
    if (this.#grabbed) this.listener.drag(at.x, at.y);
    else if (other) this.#pinch(before, at, other);
    else if (this.view.flat ? event.buttons & 2 : !(event.buttons & 6 || event.shiftKey)) {
      this.view.turn(-dx * TURN, -dy * TURN);
      this.listener.changed(false);
    } else {
      this.view.pan(dx, dy);
      this.listener.changed(true);
    }
  }

  #pinch(before: Finger, at: Finger, other: Finger): void {
    const factor =
      Math.hypot(before.x - other.x, before.y - other.y) /
      Math.max(1, Math.hypot(at.x - other.x, at.y - other.y));
    this.view.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
    this.view.zoom(factor, (at.x + other.x) / 2, (at.y + other.y) / 2);
    this.listener.changed(true);
  }

  #up(event: PointerEvent): void {
    const at = this.#at(event);
    if (!this.#fingers.delete(event.pointerId)) return;
    const click = this.#moved < STILL && event.button === 0;
    if (this.#grabbed) {
      this.#grabbed = false;
      if (click) this.listener.cancel();
      else this.listener.drop(at.x, at.y);
    }
    if (click) this.listener.click(at.x, at.y, event.shiftKey);
  }

  #cancel(event: PointerEvent): void {
    this.#fingers.delete(event.pointerId);
    if (this.#grabbed) this.listener.cancel();
    this.#grabbed = false;
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    const at = this.#at(event);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY : event.deltaY * 20;
    this.view.zoom(Math.exp(Math.max(-120, Math.min(120, lines)) * 0.002), at.x, at.y);
    this.listener.changed(false);
  }

  #key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const zoom = { "+": 0.8, "=": 0.8, "-": 1.25, _: 1.25 }[event.key];
    if (way) {
      const [x = 0, y = 0] = way;
      if (event.shiftKey) this.view.turn(x * 0.1, y * 0.1);
      else this.view.pan(x * STEP, y * STEP);
      this.listener.changed(!event.shiftKey);
    } else if (zoom) {
      this.view.zoom(zoom);
      this.listener.changed(false);
    } else if (!this.listener.key(event.key, event.shiftKey)) return;
    event.preventDefault();
    event.stopPropagation();
  }
}
