// The button that opens files of the person's machine, and the page as a place to drop them.

import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { ACCEPTED, openFiles } from "./open.ts";
import "../styles/files.css";

export function OpenButton() {
  const field = useRef<HTMLInputElement>(null);
  return (
    <>
      <button
        type="button"
        title="A trace (.mcap), programs and scenarios, or an archive of them (.zip); you can also drop them on the page"
        onClick={() => field.current?.click()}
      >
        Open a file
      </button>
      <input
        ref={field}
        type="file"
        multiple
        hidden
        accept={ACCEPTED}
        aria-label="Files to open"
        onChange={(event) => {
          const files = [...(event.currentTarget.files ?? [])];
          // The same file can be chosen again.
          event.currentTarget.value = "";
          void openFiles(files);
        }}
      />
    </>
  );
}

/** Whether files are dragged over the page. */
const over = signal(false);

const holdsFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;

export function DropPlace() {
  useEffect(() => {
    const listeners = new AbortController();
    const on = (name: "dragenter" | "dragover" | "dragleave" | "drop", act: (event: DragEvent) => void) =>
      window.addEventListener(name, (event) => holdsFiles(event) && act(event), {
        signal: listeners.signal,
        capture: true,
      });
    const show = (event: DragEvent) => {
      // Otherwise the browser would leave the page for the file.
      event.preventDefault();
      over.value = true;
    };
    on("dragenter", show);
    on("dragover", show);
    on("dragleave", (event) => {
      if (event.relatedTarget === null) over.value = false;
    });
    on("drop", (event) => {
      event.preventDefault();
      event.stopPropagation();
      over.value = false;
      void openFiles([...(event.dataTransfer?.files ?? [])]);
    });
    return () => listeners.abort();
  }, []);
  if (!over.value) return null;
  return (
    <div class="drop-place">
      <p>Drop a trace, a program or a scenario to open it here. Nothing is uploaded.</p>
    </div>
  );
}
