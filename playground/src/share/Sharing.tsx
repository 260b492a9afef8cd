// A link with the project in it, and its files to take away.

import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { download, fileName } from "../app/download.ts";
import { Dialog } from "../project/Dialog.tsx";
import { project } from "../project/project.ts";
import { seed } from "../project/running.ts";
import { write } from "./link.ts";
import { open } from "./open.ts";
import { zip } from "./zip.ts";
import "../styles/share.css";

/** Some programs shorten addresses that are longer. */
const LONG = 8000;

export function Sharing() {
  const { name, files, scenario, active } = project.value;
  const field = useRef<HTMLTextAreaElement>(null);
  const copied = useRef(signal("")).current;
  const link = new URL(
    `#${write({ name, files, scenario, active, seed: seed.value })}`,
    location.href.replace(/[?#].*/, ""),
  );
  useEffect(() => field.current?.select(), []);
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(link.href);
      copied.value = "Copied.";
    } catch {
      field.current?.select();
      copied.value = "The browser does not allow it. The link is selected: press Ctrl+C.";
    }
  };
  const text = scenario === null ? undefined : files[scenario];
  // A page that opens the archive runs its first scenario.
  const ordered = scenario === null || text === undefined ? files : { [scenario]: text, ...files };
  return (
    <Dialog
      title={`Share "${name}"`}
      close={() => {
        open.value = false;
      }}
    >
      <p>
        This link holds all files of the project. Nothing is uploaded: whoever has the link has the files.
      </p>
      <textarea ref={field} class="mono link" readOnly rows={4} aria-label="Link" value={link.href} />
      <div class="row">
        <button type="button" class="primary" onClick={copy}>
          Copy the link
        </button>
        <span role="status">{copied.value}</span>
      </div>
      {link.href.length > LONG && (
        <p class="muted">
          The link is long ({link.href.length} characters). Some mail programs cut long links.
        </p>
      )}
      <h2>Download</h2>
      <div class="row">
        <button
          type="button"
          onClick={() => download(`${fileName(name)}.zip`, "application/zip", new Blob([zip(ordered)]))}
        >
          All files (.zip)
        </button>
        {scenario !== null && text !== undefined && (
          <button
            type="button"
            onClick={() => download(scenario.replace(/^.*\//, ""), "application/toml", text)}
          >
            The scenario (.toml)
          </button>
        )}
      </div>
    </Dialog>
  );
}
