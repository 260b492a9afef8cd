// The floor, with a grid whose lines are as far apart as suits the view, and the axes.

import { Mesh, PlaneGeometry, ShaderMaterial, Vector3 } from "three";
import { gridStep } from "../scale.ts";
import type { Scene } from "../scene.ts";
import type { View } from "../view.ts";

const VERTEX = /* glsl */ `
varying vec2 place;
void main() {
  vec4 at = modelMatrix * vec4(position, 1.0);
  place = at.xy;
  gl_Position = projectionMatrix * viewMatrix * at;
}`;

const FRAGMENT = /* glsl */ `
uniform vec3 floorColor;
uniform vec3 gridColor;
uniform vec3 skyColor;
uniform vec3 center;
uniform float pace;
uniform float reach;
uniform float shown;
varying vec2 place;

float lines(float pace) {
  vec2 at = place / pace;
  vec2 width = fwidth(at);
  vec2 away = abs(fract(at - 0.5) - 0.5) / max(width, 1e-6);
  vec2 cover = clamp(1.2 - away, 0.0, 1.0) * clamp(1.0 - 3.0 * width, 0.0, 1.0);
  return max(cover.x, cover.y);
}

void main() {
  float fine = lines(pace) * 0.55;
  float coarse = lines(pace * 5.0);
  vec3 color = mix(floorColor, gridColor, max(fine, coarse) * shown);
  vec2 axis = clamp(1.5 - abs(place) / max(fwidth(place), 1e-6), 0.0, 1.0) * shown;
  color = mix(color, vec3(0.80, 0.33, 0.27), axis.y * 0.5);
  color = mix(color, vec3(0.25, 0.60, 0.35), axis.x * 0.5);
  float far = smoothstep(0.35, 1.0, distance(place, center.xy) / reach);
  gl_FragColor = vec4(mix(color, skyColor, far), 1.0);
}`;

export class Ground {
  readonly mesh: Mesh<PlaneGeometry, ShaderMaterial>;

  constructor() {
    const uniforms = {
      floorColor: { value: new Vector3() },
      gridColor: { value: new Vector3() },
      skyColor: { value: new Vector3() },
      center: { value: new Vector3() },
      pace: { value: 1 },
      reach: { value: 1 },
      shown: { value: 1 },
    };
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms,
      depthWrite: false,
    });
    this.mesh = new Mesh(new PlaneGeometry(2, 2), material);
    this.mesh.renderOrder = -10;
    this.mesh.frustumCulled = false;
  }

  update({ palette, hidden }: Scene, view: View): void {
    const uniforms = this.mesh.material.uniforms as Record<string, { value: unknown }>;
    const set = (name: string, value: unknown) => {
      const uniform = uniforms[name];
      if (uniform) uniform.value = value;
    };
    const reach = view.distance * 9 + view.span * 2;
    this.mesh.scale.set(reach, reach, 1);
    this.mesh.position.set(view.target.x, view.target.y, 0);
    set("floorColor", new Vector3(...palette.rgb.floor));
    set("gridColor", new Vector3(...palette.rgb.grid));
    set("skyColor", new Vector3(...palette.rgb.page));
    set("center", new Vector3(view.target.x, view.target.y, 0));
    set("pace", gridStep(view.pixel));
    set("reach", reach);
    set("shown", hidden.has("grid") ? 0 : 1);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
