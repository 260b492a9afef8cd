// One file of the project in an editor, in step with what others change in it.

import { useSignalEffect } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { checked, diagnostics } from "../project/checking.ts";
import { project, setText } from "../project/project.ts";
import { target } from "./jump.ts";
import type { Pane } from "./pane.ts";

/** The pane that has the focus of the toolbar. */
export const pane: { current: Pane | null } = { current: null };

export function CodePane({
  path,
  text,
  readOnly = false,
}: {
  path: string;
  text?: string;
  readOnly?: boolean;
}) {
  const host = useRef<HTMLDivElement>(null);
  const own = useRef<Pane | null>(null);
  const [problem, setProblem] = useState<string | null>(null);
  const [ready, setReady] = useState(false);
  const { id, files } = project.value;
  const file = { key: `${id}:${path}`, path, text: text ?? files[path] ?? "", readOnly };

  useEffect(() => {
    let here = true;
    import("./pane.ts").then(
      ({ Pane }) => {
        if (!here || !host.current) return;
        own.current = new Pane(host.current, file, setText);
        pane.current = own.current;
        setReady(true);
      },
      () => setProblem("The editor could not be loaded. Load the page again."),
    );
    return () => {
      here = false;
      own.current?.destroy();
      if (pane.current === own.current) pane.current = null;
      own.current = null;
    };
  }, []);

  useEffect(() => {
    // More may have been typed since the page was drawn: the newest text counts.
    if (ready) own.current?.show({ ...file, text: text ?? project.peek().files[path] ?? "" });
  }, [ready, file.key, file.text]);

  useEffect(() => {
    // Diagnostics of a text are shown with that text.
    if (ready && checked.value?.[path] === file.text) own.current?.mark(diagnostics.value);
  }, [ready, file.key, diagnostics.value]);

  useSignalEffect(() => {
    const wanted = target.value;
    if (!ready || wanted?.path !== path || !own.current) return;
    own.current.select(wanted.range);
    target.value = null;
  });
  useEffect(() => {
    const wanted = target.peek();
    if (!ready || wanted?.path !== path) return;
    own.current?.select(wanted.range);
    target.value = null;
  }, [ready, file.key]);

  if (problem) return <p class="hint">{problem}</p>;
  return <div ref={host} class="code-pane" />;
}
