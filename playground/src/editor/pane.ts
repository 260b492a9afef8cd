// A file in an editor. Loaded when the first file is shown. Changes of a file can be undone for as long as the
// page is open, also after another file was shown.
//
// The editor stands in a shadow tree: there it may bring its own style sheets, which the page's content security policy
// forbids elsewhere.

import { closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, undo } from "@codemirror/commands";
import { bracketMatching, indentOnInput, indentUnit } from "@codemirror/language";
import { lintGutter, lintKeymap, type Diagnostic as Mark, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState, type Extension } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import type { Diagnostic } from "../engine/types.ts";
import { assist, layOut } from "./assist.ts";
import { explain } from "./explain.tsx";
import { languageOf, look } from "./look.ts";
import { difference, offsetOf, type Place, type Range, rangeOf, spanOf } from "./offsets.ts";
import { wrapping } from "./wrapping.ts";

/** Of files that were shown, by project and path. */
const states = new Map<string, EditorState>();

export interface File {
  /** Tells files of the same path in different projects apart. */
  key: string;
  path: string;
  text: string;
  readOnly: boolean;
}

export class Pane {
  #view: EditorView;
  #file: File;
  #resized: ResizeObserver;

  constructor(
    host: HTMLElement,
    file: File,
    private readonly onEdit: (path: string, text: string) => void,
  ) {
    const root = host.shadowRoot ?? host.attachShadow({ mode: "open" });
    root.replaceChildren();
    root.addEventListener("keydown", keepKeys);
    this.#file = file;
    this.#view = new EditorView({ state: this.#state(file), root, parent: root });
    this.#resized = new ResizeObserver(() => this.#keepCursorInView());
    this.#resized.observe(host);
  }

  /** Shows another file, or the same one with what others have changed. */
  show(file: File): void {
    if (file.key !== this.#file.key) {
      this.#keep();
      this.#file = file;
      this.#view.setState(this.#state(file));
      return;
    }
    this.#file = file;
    const change = difference(this.#view.state.doc.toString(), file.text);
    if (change) this.#view.dispatch({ changes: change });
  }

  mark(diagnostics: Diagnostic[]): void {
    const { doc } = this.#view.state;
    const marks = diagnostics
      .filter(({ file }) => file === this.#file.path)
      .map((diagnostic) => markOf(doc, diagnostic));
    this.#view.dispatch(setDiagnostics(this.#view.state, marks));
  }

  select({ start, end }: Range): void {
    const { doc } = this.#view.state;
    const [anchor, head] = [offsetOf(doc, start), offsetOf(doc, end)];
    this.#view.dispatch({
      selection: { anchor, head },
      effects: EditorView.scrollIntoView(anchor, { y: "center" }),
    });
    this.#view.focus();
  }

  undo(): void {
    undo(this.#view);
  }

  format(): void {
    layOut(this.#view);
    this.#view.focus();
  }

  destroy(): void {
    this.#resized.disconnect();
    this.#keep();
    this.#view.destroy();
  }

  /** Problems that appear below the editor leave it less room, while a person writes there. */
  #keepCursorInView(): void {
    const { hasFocus, state } = this.#view;
    if (hasFocus) this.#view.dispatch({ effects: EditorView.scrollIntoView(state.selection.main.head) });
  }

  #keep(): void {
    if (!this.#file.readOnly) states.set(this.#file.key, this.#view.state);
  }

  #state(file: File): EditorState {
    const extensions = this.#extensions(file);
    const kept = states.get(file.key);
    if (!kept || file.readOnly) return EditorState.create({ doc: file.text, extensions });
    const change = difference(kept.doc.toString(), file.text);
    return change ? kept.update({ changes: change }).state : kept;
  }

  #extensions({ path, readOnly }: File): Extension[] {
    return [
      lineNumbers(),
      lintGutter(),
      history(),
      drawSelection(),
      indentOnInput(),
      indentUnit.of("    "),
      bracketMatching(),
      closeBrackets(),
      highlightActiveLine(),
      highlightSelectionMatches(),
      EditorState.tabSize.of(4),
      EditorState.readOnly.of(readOnly),
      EditorView.contentAttributes.of({ "aria-label": path, tabindex: "0" }),
      EditorView.updateListener.of((update) => {
        if (update.docChanged && !readOnly) this.onEdit(path, update.state.doc.toString());
      }),
      look,
      wrapping,
      languageOf(path),
      assist(path),
      keymap.of([
        // The page runs the program; the editor would add a line.
        { key: "Mod-Enter", run: () => true },
        ...closeBracketsKeymap,
        ...completionKeymap,
        ...lintKeymap,
        ...searchKeymap,
        ...historyKeymap,
        ...defaultKeymap,
        indentWithTab,
      ]),
    ];
  }
}

/** Keys that steer the run do not do so while a person writes; but Ctrl+Enter runs the program. */
function keepKeys(event: Event): void {
  if (event instanceof KeyboardEvent && event.key === "Enter" && (event.ctrlKey || event.metaKey)) return;
  event.stopPropagation();
}

/** A diagnostic with the changes that fix it, where the checker knows them. */
type Fixable = Diagnostic & { edits?: (Place & { text: string })[] };

function fix(view: EditorView, edits: (Place & { text: string })[]): void {
  const { doc } = view.state;
  const changes = edits.map((edit) => ({ ...spanOf(doc, edit), insert: edit.text }));
  view.dispatch({ changes, userEvent: "fix" });
}

function markOf(doc: EditorState["doc"], diagnostic: Fixable): Mark {
  const { severity, code, message, help, notes, edits = [] } = diagnostic;
  return {
    ...rangeOf(doc, diagnostic),
    severity,
    message,
    renderMessage: () => {
      const dom = document.createElement("span");
      dom.append(message);
      for (const more of [...notes, ...(help ? [help] : [])]) {
        const line = document.createElement("span");
        line.className = "help";
        line.textContent = more;
        dom.append(line);
      }
      return dom;
    },
    actions: [
      ...(edits.length > 0 ? [{ name: "Fix", apply: (view: EditorView) => fix(view, edits) }] : []),
      ...(code ? [{ name: `About ${code}`, apply: () => void explain(code) }] : []),
    ],
  };
}
