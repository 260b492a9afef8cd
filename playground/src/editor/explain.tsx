// The page of an error in the reference, shown in a dialog.

import { signal } from "@preact/signals";
import { Dialog } from "../project/Dialog.tsx";
import { Markdown } from "./markdown.tsx";

const explained = signal<{ code: string; text: string } | null>(null);

export async function explain(code: string): Promise<void> {
  const { pages } = await import("./pages.ts");
  const text = pages[code];
  if (text) explained.value = { code, text };
}

export function Explained() {
  const shown = explained.value;
  if (!shown) return null;
  const [title = shown.code, ...rest] = shown.text.split("\n");
  return (
    <Dialog title={title.replace(/^# /, "")} close={() => (explained.value = null)}>
      <Markdown text={rest.join("\n")} />
    </Dialog>
  );
}
