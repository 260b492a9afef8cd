// The view of the world is loaded with the first run: until an example is chosen, nothing needs it.

export const loadScreen = () => import("./world.ts");

/** The painter of 3-D pictures. */
export const loadStage = () => import("./three/stage.ts");
