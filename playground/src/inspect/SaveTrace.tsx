// Saves the run as a trace, which the command can replay and other programs can read.

import { useSignal } from "@preact/signals";
import { run } from "../app/context.ts";
import { download, fileName } from "../app/download.ts";

export function SaveTrace() {
  const making = useSignal(false);
  const save = async () => {
    making.value = true;
    try {
      const trace = await run.trace();
      const name = fileName(run.opened.value?.title ?? "run");
      download(`${name}.mcap`, "application/octet-stream", new Blob([trace]));
    } catch (error) {
      run.complain(error);
    } finally {
      making.value = false;
    }
  };
  return (
    <button
      type="button"
      disabled={making.value || run.playing.value}
      title="Everything that has happened up to the moment shown, as an MCAP file for starl replay and Foxglove"
      onClick={save}
    >
      {making.value ? "Making the trace" : "Save as trace"}
    </button>
  );
}
