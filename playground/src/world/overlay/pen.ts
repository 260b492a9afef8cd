// Draws places of the world on the canvas over it.

import type { View } from "../view.ts";

export class Pen {
  #at = new Float32Array(3);

  constructor(
    readonly context: CanvasRenderingContext2D,
    readonly view: View,
  ) {}

  /** Adds a level circle around a place to the current path. */
  circle(x: number, y: number, z: number, radius: number, sides = 32): void {
    for (let side = 0; side <= sides; side++) {
      const angle = (side / sides) * 2 * Math.PI;
      this.to(x + radius * Math.cos(angle), y + radius * Math.sin(angle), z, side === 0);
    }
  }

  /** Goes to a place, with a line or without. */
  to(x: number, y: number, z: number, start = false): void {
    this.view.project(x, y, z, this.#at);
    const [left = 0, top = 0, scale = 0] = this.#at;
    if (scale === 0) return;
    if (start) this.context.moveTo(left, top);
    else this.context.lineTo(left, top);
  }

  /** A cross of so many pixels from its middle to its ends. */
  cross(left: number, top: number, size: number): void {
    this.context.moveTo(left - size, top - size);
    this.context.lineTo(left + size, top + size);
    this.context.moveTo(left + size, top - size);
    this.context.lineTo(left - size, top + size);
  }

  stroke(color: string, width: number, alpha = 1, dash: number[] = []): void {
    this.context.globalAlpha = alpha;
    this.context.strokeStyle = color;
    this.context.lineWidth = width;
    this.context.setLineDash(dash);
    this.context.stroke();
    this.context.setLineDash([]);
    this.context.globalAlpha = 1;
  }
}
