// Panels whose code is loaded when they are shown first.

import { signal } from "@preact/signals";
import type { ComponentType } from "preact";
import { useEffect } from "preact/hooks";
import { run } from "./context.ts";

export function lazy(load: () => Promise<ComponentType>): ComponentType {
  const loaded = signal<ComponentType | null>(null);
  return function Lazy() {
    useEffect(() => {
      if (loaded.value) return;
      load().then(
        (panel) => {
          loaded.value = panel;
        },
        (error) => run.complain(error),
      );
    }, []);
    const Panel = loaded.value;
    return Panel ? <Panel /> : <p class="muted">Loading …</p>;
  };
}
