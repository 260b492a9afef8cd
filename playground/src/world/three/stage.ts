// The world painted with WebGL.

import {
  Color,
  DirectionalLight,
  Scene as Graph,
  HemisphereLight,
  Matrix4,
  Mesh,
  OrthographicCamera,
  PerspectiveCamera,
  PlaneGeometry,
  ShadowMaterial,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Painter, Scene } from "../scene.ts";
import { FIELD, type View } from "../view.ts";
import { Drawings } from "./drawings.ts";
import { Ground } from "./ground.ts";
import { pixels } from "./lines.ts";
import { Paths } from "./paths.ts";
import { Places } from "./places.ts";
import { Robots } from "./robots.ts";

/** Fleets larger than this cast no shadows. */
const MOST_SHADOWS = 300;

/** The first pictures have no shadows: what draws them takes time to prepare, and a run should begin at once. ms */
const SHADOWS_AFTER = 1000;

export class Stage implements Painter {
  #renderer: WebGLRenderer;
  #graph = new Graph();
  #perspective = new PerspectiveCamera((FIELD * 180) / Math.PI);
  #above = new OrthographicCamera();
  #sun = new DirectionalLight("#ffffff", 2);
  #sky = new HemisphereLight("#ffffff", "#b8c0c8", 1.6);
  #shade = new Mesh(new PlaneGeometry(2, 2), new ShadowMaterial({ opacity: 0.22, depthWrite: false }));
  #ground = new Ground();
  #places = new Places();
  #paths = new Paths();
  #robots = new Robots();
  #drawings = new Drawings();
  #basis = new Matrix4();
  #hasShadows = false;
  #waiting: ReturnType<typeof setTimeout> | undefined;

  /** Throws if there is no WebGL. `again` is called when the picture should be painted again. */
  constructor(
    canvas: HTMLCanvasElement,
    private readonly again: () => void,
  ) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    // The shaders are ours and three's: asking whether they compile would only make the page wait for the answer.
    this.#renderer.debug.checkShaderErrors = false;
    this.#renderer.shadowMap.enabled = true;
    this.#sun.castShadow = true;
    this.#sun.shadow.mapSize.set(2048, 2048);
    this.#sun.shadow.bias = -0.0005;
    this.#sun.shadow.normalBias = 0.01;
    this.#shade.receiveShadow = true;
    this.#shade.renderOrder = -9;
    this.#graph.background = new Color();
    this.#graph.add(this.#sun, this.#sun.target, this.#sky, this.#shade);
    this.#graph.add(this.#ground.mesh, this.#places.group, this.#paths.mesh, this.#robots.group);
    this.#graph.add(this.#drawings.marks.mesh, this.#drawings.plans.mesh, this.#drawings.stems.mesh);
  }

  resize(width: number, height: number, ratio: number): void {
    this.#renderer.setPixelRatio(ratio);
    this.#renderer.setSize(width, height, false);
    this.#renderer.getDrawingBufferSize(pixels.resolution.value);
    pixels.ratio.value = ratio;
  }

  paint(scene: Scene, view: View): void {
    this.#light(scene, view);
    this.#ground.update(scene, view);
    this.#places.update(scene);
    this.#paths.update(scene);
    this.#drawings.update(scene);
    this.#robots.update(scene);
    this.#renderer.render(this.#graph, this.#aim(view));
    // An empty world may be painted long before the run is there.
    if (scene.count > 0)
      this.#waiting ??= setTimeout(() => {
        this.#hasShadows = true;
        this.again();
      }, SHADOWS_AFTER);
  }

  dispose(): void {
    clearTimeout(this.#waiting);
    for (const part of [this.#ground, this.#places, this.#paths, this.#robots, this.#drawings])
      part.dispose();
    this.#shade.geometry.dispose();
    this.#shade.material.dispose();
    this.#renderer.dispose();
  }

  #light({ palette, hidden, fleet }: Scene, view: View): void {
    (this.#graph.background as Color).setRGB(...palette.rgb.page, "srgb");
    this.#sun.intensity = palette.dark ? 1.7 : 2;
    this.#sky.intensity = palette.dark ? 1.3 : 1.6;
    const shadows = this.#hasShadows && !hidden.has("shadows") && fleet.length <= MOST_SHADOWS;
    this.#sun.castShadow = this.#shade.visible = shadows;
    (this.#shade.material as ShadowMaterial).opacity = palette.dark ? 0.45 : 0.22;
    const { x, y } = view.target;
    const reach = view.span * 1.2 + 1;
    this.#shade.position.set(x, y, 0.001);
    this.#shade.scale.set(reach, reach, 1);
    this.#sun.target.position.set(x, y, 0);
    this.#sun.position.set(x - reach * 0.3, y - reach * 0.5, reach * 2);
    const camera = this.#sun.shadow.camera;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    [camera.near, camera.far] = [0.01 * reach, reach * 5];
    camera.updateProjectionMatrix();
  }

  #aim(view: View): PerspectiveCamera | OrthographicCamera {
    const { target, right, up, forward } = view;
    const camera = view.flat ? this.#above : this.#perspective;
    // From above, the eye is beyond everything that flies.
    const distance = view.flat ? view.distance + 1000 : view.distance;
    const back = new Vector3(-forward.x, -forward.y, -forward.z);
    this.#basis.makeBasis(vector(right), vector(up), back);
    camera.quaternion.setFromRotationMatrix(this.#basis);
    camera.position.set(target.x, target.y, target.z).addScaledVector(back, distance);
    camera.near = view.flat ? 1 : distance * 0.02;
    camera.far = view.flat ? distance + 1000 : distance * 20 + 100;
    if (camera instanceof PerspectiveCamera) camera.aspect = view.width / view.height;
    else {
      camera.right = (view.width / 2) * view.pixel;
      camera.top = (view.height / 2) * view.pixel;
      [camera.left, camera.bottom] = [-camera.right, -camera.top];
    }
    camera.updateProjectionMatrix();
    return camera;
  }
}

const vector = ({ x, y, z }: { x: number; y: number; z: number }) => new Vector3(x, y, z);
