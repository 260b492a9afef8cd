// Hover, completion, format and definitions, from the language's own tools.

import {
  autocompletion,
  type CompletionContext,
  type CompletionResult,
  snippet,
} from "@codemirror/autocomplete";
import type { Extension } from "@codemirror/state";
import { EditorView, hoverTooltip, keymap } from "@codemirror/view";
import { createElement, render } from "preact";
import { goTo } from "./jump.ts";
import { Markdown } from "./markdown.tsx";
import { difference, offsetOf, positionOf } from "./offsets.ts";
import { type Completion, complete, definition, format, hover } from "./services.ts";

export function assist(path: string): Extension {
  if (!path.endsWith(".starl")) return [];
  return [
    hoverTooltip((view, offset) => explainAt(view, path, offset)),
    autocompletion({ override: [(context) => completions(context, path)], icons: false }),
    keymap.of([
      { key: "F12", run: (view) => follow(view, path, view.state.selection.main.head) },
      { key: "Mod-Shift-f", run: (view) => layOut(view) },
    ]),
    EditorView.domEventHandlers({
      mousedown(event, view) {
        if (!(event.ctrlKey || event.metaKey) || event.button !== 0) return false;
        const offset = view.posAtCoords(event);
        return offset !== null && follow(view, path, offset);
      },
    }),
  ];
}

async function explainAt(view: EditorView, path: string, offset: number) {
  const found = await hover(path, positionOf(view.state.doc, offset));
  if (!found) return null;
  const { doc } = view.state;
  return {
    pos: offsetOf(doc, found.range.start),
    end: offsetOf(doc, found.range.end),
    above: true,
    create: () => ({ dom: markdownElement(found.markdown) }),
  };
}

function markdownElement(text: string): HTMLElement {
  const dom = document.createElement("div");
  render(createElement(Markdown, { text }), dom);
  return dom;
}

async function completions(context: CompletionContext, path: string): Promise<CompletionResult | null> {
  const word = context.matchBefore(/\w*/);
  const from = word?.from ?? context.pos;
  const afterDot = context.state.sliceDoc(from - 1, from) === ".";
  if (from === context.pos && !afterDot && !context.explicit) return null;
  const { doc } = context.state;
  const found = await complete(path, positionOf(doc, context.pos));
  if (!found || found.length === 0 || context.aborted) return null;
  return {
    from,
    validFor: /^\w*$/,
    options: found.map((completion) => ({
      label: completion.label,
      type: completion.kind,
      detail: completion.detail,
      apply: apply(completion),
      ...(completion.documentation && { info: () => markdownElement(completion.documentation ?? "") }),
    })),
  };
}

/** Places to fill in are written as in the Language Server Protocol: `$0`, `${1:name}`. */
function apply({ insert, label }: Completion) {
  const text = insert ?? label;
  if (!/\$(\d|\{)/.test(text)) return text;
  // The editor's own form has braces around every place.
  return snippet(text.replace(/\$(\d+)/g, (_, place) => `\${${place}}`).replace(/\\\$/g, "$"));
}

function follow(view: EditorView, path: string, offset: number): boolean {
  void definition(path, positionOf(view.state.doc, offset)).then(
    (found) => found && goTo(found.path, found.range, found.text),
  );
  return true;
}

/** Lays the program out as all others are. */
export function layOut(view: EditorView): boolean {
  const before = view.state.doc.toString();
  void format(before).then((after) => {
    if (typeof after !== "string" || view.state.doc.toString() !== before) return;
    const change = difference(before, after);
    if (change) view.dispatch({ changes: change, userEvent: "format" });
  });
  return true;
}
