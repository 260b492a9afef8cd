// Pointers and the wheel on the diagram: a drag moves it, the wheel or two fingers zoom in time.

import { panColumns, panTime, size, span, zoom } from "./view.ts";

interface Heard {
  onClick: (x: number, y: number, finger: boolean) => void;
  onHover: (x: number, y: number) => void;
}

/** A pointer that moves less than this clicks, px. */
const STILL = 5;

export class Gestures {
  #pointers = new Map<number, { x: number; y: number }>();
  #moved = 0;
  #listeners = new AbortController();

  constructor(
    private readonly element: HTMLElement,
    private readonly heard: Heard,
  ) {
    const { signal } = this.#listeners;
    element.addEventListener("pointerdown", (event) => this.#down(event), { signal });
    element.addEventListener("pointermove", (event) => this.#move(event), { signal });
    element.addEventListener("pointerup", (event) => this.#up(event), { signal });
    element.addEventListener("pointercancel", (event) => this.#pointers.delete(event.pointerId), { signal });
    // Not passive: the wheel must not scroll the page.
    element.addEventListener("wheel", (event) => this.#wheel(event), { signal, passive: false });
  }

  end(): void {
    this.#listeners.abort();
  }

  #place(event: { clientX: number; clientY: number }): { x: number; y: number } {
    const box = this.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  #down(event: PointerEvent): void {
    this.element.setPointerCapture(event.pointerId);
    if (this.#pointers.size === 0) this.#moved = 0;
    this.#pointers.set(event.pointerId, this.#place(event));
  }

  #move(event: PointerEvent): void {
    const before = this.#pointers.get(event.pointerId);
    const here = this.#place(event);
    if (!before) {
      this.heard.onHover(here.x, here.y);
      return;
    }
    const others = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    this.#pointers.set(event.pointerId, here);
    this.#moved += Math.abs(here.x - before.x) + Math.abs(here.y - before.y);
    if (this.#moved < STILL) return;
    const [other] = others;
    if (other) {
      const [was, is] = [Math.abs(before.y - other.y), Math.abs(here.y - other.y)];
      if (was > 10 && is > 10) zoom(was / is, (here.y + other.y) / 2);
    } else {
      const change = here.y - before.y;
      // Across the diagram only columns move, so that it still follows the moment shown.
      if (change !== 0) panTime((-change / Math.max(1, size.value.height)) * span.value);
      panColumns(before.x - here.x);
    }
  }

  #up(event: PointerEvent): void {
    if (!this.#pointers.delete(event.pointerId) || this.#moved >= STILL) return;
    const { x, y } = this.#place(event);
    this.heard.onClick(x, y, event.pointerType === "touch");
  }

  #wheel(event: WheelEvent): void {
    event.preventDefault();
    if (event.shiftKey) panColumns(event.deltaY || event.deltaX);
    else if (Math.abs(event.deltaX) > Math.abs(event.deltaY)) panColumns(event.deltaX);
    else zoom(Math.exp(event.deltaY / 400), this.#place(event).y);
  }
}
