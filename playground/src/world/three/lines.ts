// Lines of a width in pixels, whole or dotted, and round dots: many in one draw call. Colours are those of the screen,
// so they are written as they are.

import {
  type BufferGeometry,
  DoubleSide,
  Float32BufferAttribute,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
  ShaderMaterial,
  type Texture,
  Vector2,
} from "three";
import type { Rgb } from "../palette.ts";

const VERTEX = /* glsl */ `
attribute vec3 start;
attribute vec3 end;
#ifdef PALETTE
attribute float robot;
uniform sampler2D palette;
uniform float width;
#else
attribute vec4 tint;
attribute vec2 form;
#endif
uniform vec2 resolution;
uniform float ratio;
flat varying vec2 from;
flat varying vec2 to;
flat varying vec4 paint;
flat varying vec2 look;

void main() {
  vec4 a = modelViewMatrix * vec4(start, 1.0);
  vec4 b = modelViewMatrix * vec4(end, 1.0);
  if (projectionMatrix[2][3] == -1.0) {
    // Parts behind the eye are cut off.
    float near = -0.5 * projectionMatrix[3][2] / projectionMatrix[2][2];
    near = min(near, -1e-4);
    if (a.z > near && b.z < near) a = mix(a, b, (a.z - near) / (a.z - b.z));
    else if (b.z > near && a.z < near) b = mix(b, a, (b.z - near) / (b.z - a.z));
  }
#ifdef PALETTE
  paint = texelFetch(palette, ivec2(int(robot), 0), 0);
  look = vec2(width, 0.0) * ratio;
#else
  paint = tint;
  look = form * ratio;
#endif
  vec4 clipA = projectionMatrix * a;
  vec4 clipB = projectionMatrix * b;
  from = (clipA.xy / clipA.w * 0.5 + 0.5) * resolution;
  to = (clipB.xy / clipB.w * 0.5 + 0.5) * resolution;
  vec2 along = to - from;
  float size = length(along);
  along = size > 1e-4 ? along / size : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  float half_width = 0.5 * look.x + 1.0;
  vec4 clip = position.y < 0.5 ? clipA : clipB;
  vec2 offset = (across * position.x + along * (position.y * 2.0 - 1.0)) * half_width;
  clip.xy += offset / resolution * 2.0 * clip.w;
  gl_Position = clip;
}`;

const FRAGMENT = /* glsl */ `
flat varying vec2 from;
flat varying vec2 to;
flat varying vec4 paint;
flat varying vec2 look;

void main() {
  vec2 way = to - from;
  float size = length(way);
  vec2 along = size > 1e-4 ? way / size : vec2(1.0, 0.0);
  vec2 off = gl_FragCoord.xy - from;
  float place = clamp(dot(off, along), 0.0, size);
  // Dotted: the nearest dot rather than the nearest place.
  if (look.y > 0.0) place = min(floor(place / look.y + 0.5) * look.y, size);
  float away = distance(off, along * place);
  float cover = clamp(0.5 * look.x - away + 0.5, 0.0, 1.0);
  if (cover * paint.a < 0.02) discard;
  gl_FragColor = vec4(paint.rgb, paint.a * cover);
}`;

/** The pixels of the drawing, shared by all lines. */
export const pixels = { resolution: { value: new Vector2(1, 1) }, ratio: { value: 1 } };

/** For numbers of so many floats each in `buffer`; `attributes` are sizes and offsets by name. */
export function instanced(
  buffer: InstancedInterleavedBuffer,
  attributes: Record<string, [size: number, offset: number]>,
): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute([-1, 0, 0, 1, 0, 0, -1, 1, 0, 1, 1, 0], 3));
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  for (const [name, [size, offset]] of Object.entries(attributes)) {
    geometry.setAttribute(name, new InterleavedBufferAttribute(buffer, size, offset));
  }
  return geometry;
}

/** Lines whose robots' colours are in a texture, if there is one. */
export function lineMaterial(palette?: Texture, width = 1): ShaderMaterial {
  const uniforms = palette
    ? { ...pixels, palette: { value: palette }, width: { value: width } }
    : { ...pixels };
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms,
    defines: palette ? { PALETTE: "" } : {},
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
  });
}

const STRIDE = 12;

/** Lines that are replaced whenever they change: `begin`, `add` each, `end`. */
export class Lines {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  #numbers = new Float32Array(64 * STRIDE);
  #count = 0;
  #buffer: InstancedInterleavedBuffer | null = null;
  #geometry = new InstancedBufferGeometry();

  constructor(order = 0) {
    this.mesh = new Mesh<BufferGeometry, ShaderMaterial>(this.#geometry, lineMaterial());
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = order;
    this.mesh.visible = false;
  }

  begin(): void {
    this.#count = 0;
  }

  /** A line from one place to another; from a place to itself it is a dot. A dotted one has `gap` pixels from dot to dot.
   * `lift` metres are added to the heights. */
  add(
    a: { x: number; y: number; z: number },
    b: typeof a,
    color: Rgb,
    alpha: number,
    width: number,
    gap = 0,
    lift = 0,
  ): void {
    const at = this.#count++ * STRIDE;
    if (at + STRIDE > this.#numbers.length) {
      const larger = new Float32Array(this.#numbers.length * 2);
      larger.set(this.#numbers);
      this.#numbers = larger;
    }
    const numbers = this.#numbers;
    // One by one: lists on both sides would leave 12 MB a second to the garbage collector in a world of 1,000 robots.
    numbers[at] = a.x;
    numbers[at + 1] = a.y;
    numbers[at + 2] = a.z + lift;
    numbers[at + 3] = b.x;
    numbers[at + 4] = b.y;
    numbers[at + 5] = b.z + lift;
    numbers[at + 6] = color[0];
    numbers[at + 7] = color[1];
    numbers[at + 8] = color[2];
    numbers[at + 9] = alpha;
    numbers[at + 10] = width;
    numbers[at + 11] = gap;
  }

  end(): void {
    this.mesh.visible = this.#count > 0;
    if (this.#count === 0) return;
    if (this.#buffer?.array !== this.#numbers) {
      this.#buffer = new InstancedInterleavedBuffer(this.#numbers, STRIDE, 1);
      this.#geometry.dispose();
      this.#geometry = instanced(this.#buffer, { start: [3, 0], end: [3, 3], tint: [4, 6], form: [2, 10] });
      this.mesh.geometry = this.#geometry;
    }
    this.#buffer.clearUpdateRanges();
    this.#buffer.addUpdateRange(0, this.#count * STRIDE);
    this.#buffer.needsUpdate = true;
    this.#geometry.instanceCount = this.#count;
  }

  dispose(): void {
    this.#geometry.dispose();
    this.mesh.material.dispose();
  }
}
