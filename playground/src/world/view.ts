// From where the world is seen: a place that is looked at, how much of the world around it fits on the screen, and the
// direction. Seen from above there is no perspective.

export interface Place {
  x: number;
  y: number;
  z: number;
}

export interface Box {
  low: Place;
  high: Place;
}

/** The angle of the picture's height, radians. */
export const FIELD = (36 * Math.PI) / 180;
const FIELD_TANGENT = 2 * Math.tan(FIELD / 2);
/** Angles from the vertical in 3-D, radians. */
const [STEEPEST, FLATTEST] = [0.02, 1.52];
/** Metres across the shorter side of the picture. */
const [LEAST_SPAN, MOST_SPAN] = [0.05, 20_000];

export class View {
  readonly target: Place = { x: 0, y: 0, z: 0 };
  /** Metres across the shorter side of the picture, at the place that is looked at. */
  span = 8;
  /** The direction that is up on the screen, radians from the x axis: from above, and in 3-D. */
  #north = Math.PI / 2;
  #azimuth = 1.8;
  /** The angle between the line of sight and the vertical in 3-D, radians. */
  tilt = 0.72;
  flat = false;
  /** px */
  width = 1;
  height = 1;
  /** Unit vectors: right, up and forward on the screen. */
  readonly right: Place = { x: 1, y: 0, z: 0 };
  readonly up: Place = { x: 0, y: 1, z: 0 };
  readonly forward: Place = { x: 0, y: 0, z: -1 };

  constructor() {
    this.turn(0, 0);
  }

  /** Metres in a pixel at the place that is looked at. */
  get pixel(): number {
    return this.span / Math.min(this.width, this.height);
  }

  /** From the eye to the place that is looked at, m. */
  get distance(): number {
    return (this.pixel * this.height) / FIELD_TANGENT;
  }

  get azimuth(): number {
    return this.flat ? this.#north : this.#azimuth;
  }

  setFlat(flat: boolean): void {
    this.flat = flat;
    this.turn(0, 0);
  }

  turn(azimuth: number, tilt: number): void {
    if (this.flat) this.#north += azimuth;
    else {
      this.#azimuth += azimuth;
      this.tilt = Math.min(FLATTEST, Math.max(STEEPEST, this.tilt + tilt));
    }
    const [sin, cos] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
    const [down, along] = this.flat ? [1, 0] : [Math.cos(this.tilt), Math.sin(this.tilt)];
    Object.assign(this.right, { x: sin, y: -cos, z: 0 });
    Object.assign(this.up, { x: down * cos, y: down * sin, z: along });
    Object.assign(this.forward, { x: along * cos, y: along * sin, z: -down });
  }

  /** Moves the world on the screen by so many pixels. */
  pan(x: number, y: number): void {
    const along = (y * this.pixel) / (this.flat ? 1 : Math.max(0.25, Math.cos(this.tilt)));
    const across = x * this.pixel;
    this.target.x += Math.cos(this.azimuth) * along - this.right.x * across;
    this.target.y += Math.sin(this.azimuth) * along - this.right.y * across;
  }

  /** Shows `factor` times as much; what is at a place of the screen stays there. */
  zoom(factor: number, x = this.width / 2, y = this.height / 2): void {
    const before = this.floorAt(x, y);
    this.span = Math.min(MOST_SPAN, Math.max(LEAST_SPAN, this.span * factor));
    const after = this.floorAt(x, y);
    if (!before || !after || Math.hypot(before.x - after.x, before.y - after.y) > this.span) return;
    this.target.x += before.x - after.x;
    this.target.y += before.y - after.y;
  }

  /**
   * Where a place is on the screen: x and y in pixels, and pixels in a metre there, 0 if it is behind the eye.
   * Written into `out` at `index`, without a new object: it is called for every robot and frame.
   */
  project(x: number, y: number, z: number, out: Float32Array, index = 0): void {
    const { target, right, up, forward } = this;
    const dx = x - target.x;
    const dy = y - target.y;
    const dz = z - target.z;
    let scale = 1 / this.pixel;
    if (!this.flat) {
      const distance = this.distance;
      const depth = distance + dx * forward.x + dy * forward.y + dz * forward.z;
      scale = depth > distance * 0.02 ? (scale * distance) / depth : 0;
    }
    out[index] = this.width / 2 + (dx * right.x + dy * right.y) * scale;
    out[index + 1] = this.height / 2 - (dx * up.x + dy * up.y + dz * up.z) * scale;
    out[index + 2] = scale;
  }

  /** The place at a height that is seen at a place of the screen; null above the horizon. */
  floorAt(x: number, y: number, z = 0): { x: number; y: number } | null {
    const across = (x - this.width / 2) * this.pixel;
    const along = (this.height / 2 - y) * this.pixel;
    const { right, up, forward, target } = this;
    const at = {
      x: target.x + right.x * across + up.x * along,
      y: target.y + right.y * across + up.y * along,
      z: target.z + up.z * along,
    };
    if (this.flat) return { x: at.x, y: at.y };
    const distance = this.distance;
    const ray = {
      x: at.x - target.x + forward.x * distance,
      y: at.y - target.y + forward.y * distance,
      z: at.z - target.z + forward.z * distance,
    };
    const share = (z - at.z) / ray.z;
    if (ray.z >= -1e-9 || share < -1 || share > 50) return null;
    return { x: at.x + ray.x * share, y: at.y + ray.y * share };
  }

  /** Looks at all of a box, with a margin in pixels at each side. */
  fit(box: Box, margin = { x: 36, top: 64, bottom: 44 }): void {
    const { low, high } = box;
    this.target.x = (low.x + high.x) / 2;
    this.target.y = (low.y + high.y) / 2;
    this.target.z = (low.z + high.z) / 2;
    const room = {
      x: Math.max(60, this.width - 2 * margin.x),
      y: Math.max(60, this.height - margin.top - margin.bottom),
    };
    this.span = Math.max(0.5, 2 * Math.hypot(high.x - low.x, high.y - low.y, high.z - low.z));
    // Perspective makes what is near larger, so the size is found step by step.
    for (let step = 0; step < 6; step++) {
      const { left, right, top, bottom } = this.#seen(box);
      const factor = Math.max((right - left) / room.x, (bottom - top) / room.y, 0.5 / this.span);
      this.span = Math.min(MOST_SPAN, this.span * factor);
      const middle = { x: this.width / 2, y: margin.top + room.y / 2 };
      this.#shift(middle.x - (left + right) / 2, middle.y - (top + bottom) / 2, factor);
    }
  }

  /** Moves what is seen by so many pixels, as they were before the view showed `factor` times as much. */
  #shift(x: number, y: number, factor: number): void {
    const pixel = this.pixel / factor;
    for (const axis of ["x", "y", "z"] as const) {
      this.target[axis] += (this.up[axis] * y - this.right[axis] * x) * pixel;
    }
  }

  /** The part of the screen that a box takes, px. */
  #seen(box: Box): { left: number; right: number; top: number; bottom: number } {
    const at = new Float32Array(3);
    const seen = { left: Infinity, right: -Infinity, top: Infinity, bottom: -Infinity };
    for (let corner = 0; corner < 8; corner++) {
      const place = (axis: "x" | "y" | "z", bit: number) => (corner & bit ? box.high : box.low)[axis];
      this.project(place("x", 1), place("y", 2), place("z", 4), at);
      const [x = 0, y = 0, scale = 0] = at;
      if (scale === 0) return { left: -1e4, right: 1e4, top: -1e4, bottom: 1e4 };
      seen.left = Math.min(seen.left, x);
      seen.right = Math.max(seen.right, x);
      seen.top = Math.min(seen.top, y);
      seen.bottom = Math.max(seen.bottom, y);
    }
    return seen;
  }

  /** Whether a box is on the screen, all of it. */
  holds(box: Box): boolean {
    const { left, right, top, bottom } = this.#seen(box);
    return left >= 0 && top >= 0 && right <= this.width && bottom <= this.height;
  }
}
