// Hover, completion, format and definitions, from the language's own tools.

import {
  autocompletion,
  type Completion,
  type CompletionContext,
  type CompletionResult,
  pickedCompletion,
} from "@codemirror/autocomplete";
import type { Extension } from "@codemirror/state";
import { EditorView, hoverTooltip, keymap } from "@codemirror/view";
import { createElement, render } from "preact";
import { goTo } from "./jump.ts";
import { Markdown } from "./markdown.tsx";
import { difference, offsetOf, positionOf } from "./offsets.ts";
import { complete, definition, format, hover, type Completion as Offer } from "./services.ts";

export function assist(path: string): Extension {
  if (!path.endsWith(".starl")) return [];
  return [
    hoverTooltip((view, offset) => explainAt(view, path, offset), { hideOnChange: true }),
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
  const word = context.matchBefore(/\w+/);
  const afterDot = context.state.sliceDoc(context.pos - 1, context.pos) === ".";
  if (!word && !afterDot && !context.explicit) return null;
  const { doc } = context.state;
  const found = await complete(path, positionOf(doc, context.pos));
  const first = found?.[0];
  if (!found || !first || context.aborted) return null;
  return {
    from: offsetOf(doc, first.range.start),
    validFor: /^\w*$/,
    options: found.map((completion, rank) => optionOf(completion, found.length - rank)),
  };
}

/** The likeliest come first, as the language says. */
function optionOf({ label, detail, documentation, insert, cursor }: Offer, rank: number): Completion {
  return {
    label,
    boost: Math.min(99, rank),
    ...(detail && { detail }),
    ...(documentation && { info: () => markdownElement(documentation) }),
    apply: (view, completion, from, to) =>
      view.dispatch({
        changes: { from, to, insert },
        selection: { anchor: from + cursor },
        annotations: pickedCompletion.of(completion),
        userEvent: "input.complete",
      }),
  };
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
