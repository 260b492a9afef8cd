// Long lines continue below, deeper than they begin, so that the structure of a program is still seen.

import type { Extension } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, ViewPlugin, type ViewUpdate } from "@codemirror/view";

/** How much deeper the rest of a line stands, and the deepest place where it does, columns. */
const DEEPER = 4;
const DEEPEST = 20;

const marks = Array.from({ length: DEEPEST + 1 }, (_, column) =>
  Decoration.line({ class: `cm-hang-${column}` }),
);

const theme = EditorView.theme(
  Object.fromEntries(
    marks.map((_, column) => [
      `.cm-line.cm-hang-${column}`,
      // 6 px is the padding of every line.
      { paddingLeft: `calc(${column}ch + 6px)`, textIndent: `-${column}ch` },
    ]),
  ),
);

function hangs(view: EditorView): DecorationSet {
  const ranges = [];
  for (const { from, to } of view.visibleRanges) {
    for (let at = from; at <= to; ) {
      const line = view.state.doc.lineAt(at);
      const indent = /^ */.exec(line.text)?.[0].length ?? 0;
      const mark = marks[Math.min(DEEPEST, indent + DEEPER)];
      if (mark) ranges.push(mark.range(line.from));
      at = line.to + 1;
    }
  }
  return Decoration.set(ranges);
}

const plugin = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;
    constructor(view: EditorView) {
      this.decorations = hangs(view);
    }
    update(update: ViewUpdate): void {
      if (update.docChanged || update.viewportChanged) this.decorations = hangs(update.view);
    }
  },
  { decorations: (plugin) => plugin.decorations },
);

export const wrapping: Extension = [EditorView.lineWrapping, plugin, theme];
