// Which panel of the inspector is shown.

import { signal } from "@preact/signals";

export const sideTab = signal("robots");
