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
/** Angles from the vertical in 3-D, radians. */
const [STEEPEST, FLATTEST] = [0.02, 1.52];
/** Metres across the shorter side of the picture. */
const [LEAST_SPAN, MOST_SPAN] = [0.05, 20_000];

export class View {
  readonly target: Place = { x: 0, y: 0, z: 0 };
  /** Metres across the shorter side of the picture, at the place that is looked at. */
  span = 8;
  /** The direction that is up on the screen from above, radians from the x axis. */
  azimuth = Math.PI / 2;
  /** The angle between the line of sight and the vertical in 3-D, radians. */
  tilt = 0.87;
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
    return (this.pixel * this.height) / (2 * Math.tan(FIELD / 2));
  }

  setFlat(flat: boolean): void {
    this.flat = flat;
    this.turn(0, 0);
  }

  turn(azimuth: number, tilt: number): void {
    this.azimuth += azimuth;
    this.tilt = Math.min(FLATTEST, Math.max(STEEPEST, this.tilt + tilt));
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
    const [dx, dy, dz] = [x - this.target.x, y - this.target.y, z - this.target.z];
    const { right, up, forward } = this;
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
  fit({ low, high }: Box, margin = { x: 40, top: 60, bottom: 50 }): void {
    const center = { x: (low.x + high.x) / 2, y: (low.y + high.y) / 2, z: (low.z + high.z) / 2 };
    const half = { x: (high.x - low.x) / 2, y: (high.y - low.y) / 2, z: (high.z - low.z) / 2 };
    const reach = (axis: Place) =>
      Math.abs(axis.x) * half.x + Math.abs(axis.y) * half.y + Math.abs(axis.z) * half.z;
    const room = {
      x: Math.max(60, this.width - 2 * margin.x),
      y: Math.max(60, this.height - margin.top - margin.bottom),
    };
    const pixel = Math.max((2 * reach(this.right)) / room.x, (2 * reach(this.up)) / room.y);
    // Perspective makes the near half larger.
    const larger = this.flat
      ? 1
      : 1 + reach(this.forward) / Math.max(1e-9, (pixel * this.height) / (2 * Math.tan(FIELD / 2)));
    this.span = Math.min(MOST_SPAN, Math.max(0.5, pixel * larger * Math.min(this.width, this.height)));
    Object.assign(this.target, center);
    const shift = ((margin.top - margin.bottom) / 2) * this.pixel;
    this.target.x += this.up.x * shift;
    this.target.y += this.up.y * shift;
    this.target.z += this.up.z * shift;
  }

  /** Whether a box is on the screen, all of it. */
  holds(box: Box): boolean {
    const at = new Float32Array(3);
    for (let corner = 0; corner < 8; corner++) {
      const place = (axis: "x" | "y" | "z", bit: number) => (corner & bit ? box.high : box.low)[axis];
      this.project(place("x", 1), place("y", 2), place("z", 4), at);
      const [x = 0, y = 0, scale = 0] = at;
      if (scale === 0 || x < 0 || y < 0 || x > this.width || y > this.height) return false;
    }
    return true;
  }
}
