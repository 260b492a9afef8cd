// Which parts of the page are shown.

import { signal } from "@preact/signals";

/** Which part a small screen shows. */
export const part = signal<"write" | "world" | "inspect">("world");

/** Which tab of the editing side is shown. */
export const benchTab = signal("gallery");

/** Which tab of the inspector is shown. */
export const sideTab = signal("robots");
