// Everything that a picture of the world is painted from, at the moment shown. Painters read it and change nothing.

import type { Member, Robot, World } from "../engine/types.ts";
import type { History } from "../run/history.ts";
import type { Happenings } from "./happenings.ts";
import type { Layer } from "./layers.ts";
import type { Palette, Rgb } from "./palette.ts";
import type { View } from "./view.ts";

export const [RUNNING, FINISHED, FAILED, DOWN, LEFT] = [0, 1, 2, 3, 4] as const;

export interface Scene {
  /** s */
  now: number;
  /** POSE_NUMBERS numbers for each robot. */
  poses: Float64Array | Float32Array;
  /** How many robots there are. */
  count: number;
  fleet: Member[];
  states: (string | null)[];
  world: World;
  history: History;
  happenings: Happenings;
  selected: number[];
  /** Those of the selected robots whose state is known. */
  robots: Robot[];
  message: { from: number; sequence: number } | null;
  /** Seconds of the run in which something that has just happened is still shown. */
  linger: number;
  hidden: ReadonlySet<Layer>;
  palette: Palette;
  colors: { css: string[]; rgb: Rgb[] };
  /** How high what reaches to the sky is drawn, m. */
  sky: number;
  /** The radio's range, m; null where there is none or where it is not known. */
  range: number | null;
  /** How much larger than they are robots are drawn, so that they are seen. */
  enlarged: number;
}

/** Paints the world, not what is written over it. */
export interface Painter {
  resize(width: number, height: number, ratio: number): void;
  paint(scene: Scene, view: View): void;
  dispose(): void;
}
