// How the editor looks: the page's colours, which reach into it as variables.

import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import type { Extension } from "@codemirror/state";
import { EditorView } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { starl, starlIndent } from "./starl.ts";

const tomlLanguage = StreamLanguage.define({ ...toml, languageData: { commentTokens: { line: "#" } } });

export function languageOf(path: string): Extension {
  if (path.endsWith(".starl")) return [starl, starlIndent];
  return path.endsWith(".toml") ? tomlLanguage : [];
}

const style = HighlightStyle.define([
  { tag: [tags.controlKeyword, tags.operatorKeyword, tags.definitionKeyword], color: "var(--primitive)" },
  { tag: tags.definitionKeyword, color: "var(--primitive)", fontWeight: "600" },
  { tag: [tags.typeName, tags.heading], color: "var(--program)" },
  { tag: [tags.number, tags.bool, tags.atom], color: "var(--fault)" },
  { tag: tags.string, color: "var(--good)" },
  { tag: [tags.lineComment, tags.docComment, tags.comment], color: "var(--muted)", fontStyle: "italic" },
  { tag: tags.function(tags.variableName), color: "var(--accent)" },
  { tag: tags.function(tags.propertyName), color: "var(--accent)" },
  { tag: tags.definition(tags.variableName), color: "var(--accent)", fontWeight: "600" },
  { tag: tags.self, fontStyle: "italic" },
]);

const theme = EditorView.theme({
  "&": { height: "100%", color: "var(--text)", backgroundColor: "var(--panel)", fontSize: "13px" },
  "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "-2px" },
  ".cm-scroller": {
    fontFamily: 'ui-monospace, "SFMono-Regular", Menlo, Consolas, "DejaVu Sans Mono", monospace',
    lineHeight: "1.5",
  },
  ".cm-content": { caretColor: "var(--text)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  "& .cm-selectionBackground, &.cm-focused .cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground":
    { backgroundColor: "var(--accent-soft)" },
  ".cm-gutters": { backgroundColor: "var(--panel)", color: "var(--muted)", border: "0" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "transparent" },
  "&.cm-focused .cm-activeLine": { backgroundColor: "color-mix(in srgb, var(--raised) 50%, transparent)" },
  ".cm-tooltip": {
    backgroundColor: "var(--panel)",
    color: "var(--text)",
    border: "1px solid var(--line)",
    borderRadius: "6px",
    maxWidth: "min(560px, 90vw)",
    maxHeight: "320px",
    overflow: "auto",
    boxShadow: "0 4px 16px rgb(0 0 0 / 0.2)",
    zIndex: "20",
  },
  ".cm-tooltip .markdown": { padding: "6px 10px" },
  ".cm-tooltip p, .cm-tooltip pre": { margin: "0 0 6px", whiteSpace: "pre-wrap" },
  ".cm-tooltip pre, .cm-tooltip code": { fontFamily: "ui-monospace, monospace", fontSize: "12.5px" },
  ".cm-tooltip-autocomplete > ul > li[aria-selected]": {
    backgroundColor: "var(--accent)",
    color: "var(--accent-text)",
  },
  ".cm-completionDetail": { fontStyle: "normal", opacity: "0.8" },
  ".cm-completionInfo": { padding: "0" },
  ".cm-diagnostic": { padding: "6px 10px" },
  ".cm-diagnostic-error": { borderLeft: "4px solid var(--violation)" },
  ".cm-diagnostic-warning": { borderLeft: "4px solid var(--fault)" },
  ".cm-diagnostic .help": { color: "var(--muted)", display: "block" },
  ".cm-diagnosticAction": {
    font: "inherit",
    fontSize: "12.5px",
    color: "var(--accent)",
    background: "none",
    border: "0",
    padding: "2px 0",
    margin: "0",
    textDecoration: "underline",
    display: "block",
    cursor: "pointer",
  },
  ".cm-panels": { backgroundColor: "var(--raised)", color: "var(--text)" },
  ".cm-panels .cm-textfield": { backgroundColor: "var(--panel)", color: "var(--text)" },
  ".cm-panels .cm-button": { backgroundImage: "none", backgroundColor: "var(--panel)", color: "var(--text)" },
  ".cm-searchMatch": { backgroundColor: "var(--warn-soft)" },
  ".cm-matchingBracket": { backgroundColor: "var(--accent-soft) !important" },
  "& .cm-selectionMatch": { backgroundColor: "var(--known)" },
});

export const look: Extension = [theme, syntaxHighlighting(style)];
