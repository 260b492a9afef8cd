// Actions of the title bar beside the title; each part of the page has its own file for its actions.

import { RunBar } from "../project/RunBar.tsx";
import { Share } from "../share/Share.tsx";
import { start } from "./context.ts";

export function HeaderActions() {
  if (start.value.mode !== "web") return null;
  return (
    <>
      <Share />
      <RunBar />
    </>
  );
}
