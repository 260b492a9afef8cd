// The button that shows a link with the project in it, and the dialog about a link that was followed.

import { lazy } from "../app/lazy.tsx";
import { Incoming } from "./Incoming.tsx";
import { open } from "./open.ts";

const Sharing = lazy(async () => (await import("./Sharing.tsx")).Sharing);

export function Share() {
  return (
    <>
      <button
        type="button"
        class="share"
        onClick={() => {
          open.value = true;
        }}
      >
        Share
      </button>
      {open.value && <Sharing />}
      <Incoming />
    </>
  );
}
