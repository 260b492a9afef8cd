// Whether the dialog with the link is shown.

import { signal } from "@preact/signals";

export const open = signal(false);
