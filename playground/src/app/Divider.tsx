// The border between what is written and the world. It can be moved with the mouse, a finger or the arrow keys.

import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { remember, remembered } from "../project/storage.ts";

const [LEAST, MOST, STEP] = [18, 70, 2];

const before = remembered("bench");
/** Of the page's width, %. */
const share = signal(typeof before === "number" ? limited(before) : 32);

function limited(percent: number): number {
  return Math.min(MOST, Math.max(LEAST, percent));
}

function move(percent: number): void {
  share.value = limited(percent);
  remember("bench", share.value);
}

export function Divider() {
  useEffect(() => {
    document.documentElement.style.setProperty("--bench", `${share.value}%`);
  }, [share.value]);
  return (
    <hr
      class="divider"
      tabIndex={0}
      aria-orientation="vertical"
      aria-label="Width of the editor"
      aria-valuenow={Math.round(share.value)}
      aria-valuemin={LEAST}
      aria-valuemax={MOST}
      onKeyDown={(event) => {
        const step = { ArrowLeft: -STEP, ArrowRight: STEP }[event.key];
        if (step) move(share.value + step);
      }}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) move((event.clientX / innerWidth) * 100);
      }}
    />
  );
}
