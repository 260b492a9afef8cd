// Parts of the page that show a run. Their code is loaded when they are first needed, or at once if a run is expected.

/** The view of the world. */
export const loadScreen = () => import("../world/world.ts");

/** The painter of 3-D pictures. */
export const loadStage = () => import("../world/three/stage.ts");

export const loadRobots = async () => (await import("../inspect/Robots.tsx")).Robots;

export const loadTimeline = async () => (await import("../timeline/Timeline.tsx")).Timeline;
