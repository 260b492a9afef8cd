// Colours for the StarL language, as editors/vscode/syntaxes has them.

import { type IndentContext, indentService, StreamLanguage, type StringStream } from "@codemirror/language";

const DECLARATIONS = new Set(
  "program library import enum record message function param const allread allwrite stable role init atomic on check invariant always eventually".split(
    " ",
  ),
);
const CONTROL = new Set("if then elif else for in return let pre every eff".split(" "));
const OPERATORS = new Set(
  "and or not some by forall exists leads_to within recovers assuming despite crashes".split(" "),
);
const ATOMS = new Set(["true", "false", "none"]);
const TYPES = new Set(
  "Bool Int Float String Point Time Duration RobotId Area Obstacles List Set Map".split(" "),
);
const OWN = new Set("me position heading velocity now peers role".split(" "));
/** The kinds of declarations of these words. */
const NAMED =
  /^(program|library|import|enum|record|message|function|role|invariant|always|eventually|input)$/;

interface State {
  /** The word before, in the same line. */
  before: string;
  inString: boolean;
}

export const starl = StreamLanguage.define<State>({
  name: "starl",
  startState: () => ({ before: "", inString: false }),
  token(stream, state) {
    if (stream.sol()) {
      state.before = "";
      state.inString = false;
    }
    if (state.inString) return string(stream, state);
    if (stream.eatSpace()) return null;
    if (stream.match(/^\/\/\/.*/)) return "docComment";
    if (stream.match(/^\/\/.*/)) return "lineComment";
    if (stream.eat('"')) {
      state.inString = true;
      return string(stream, state);
    }
    if (
      stream.match(/^[0-9][0-9_]*(\.[0-9][0-9_]*)?([eE][+-]?[0-9]+)?(ns|us|ms|s|min|h|mm|cm|m|km|deg|rad)?\b/)
    ) {
      return "number";
    }
    const word = stream.match(/^[A-Za-z_][A-Za-z0-9_]*/);
    if (word) return name(Array.isArray(word) ? (word[0] ?? "") : "", stream, state);
    state.before = stream.next() ?? "";
    return /[-+*/%=<>!?]/.test(state.before) ? "operator" : "punctuation";
  },
  languageData: {
    commentTokens: { line: "//" },
    closeBrackets: { brackets: ["(", "[", "{", '"'] },
    indentOnInput: /^\s*(elif|else)\b/,
  },
});

/** A block is indented by four spaces, as `starl fmt` does. */
export const starlIndent = indentService.of((context, pos) => {
  const line = context.lineAt(pos, 1);
  const before = lineBefore(context, pos);
  // A blank line ends a declaration.
  if (before === null || before.trim() === "") return 0;
  const indent = /^ */.exec(before)?.[0].length ?? 0;
  if (/^\s*(elif|else)\b/.test(line.text)) return Math.max(0, indent - 4);
  return opensBlock(before) ? indent + 4 : indent;
});

/** The text of the line before; null at the start. While Enter is handled, that is the part before the cursor. */
function lineBefore(context: IndentContext, pos: number): string | null {
  if (context.simulatedBreak === pos) return context.lineAt(pos, -1).text;
  const { from } = context.state.doc.lineAt(pos);
  return from === 0 ? null : context.state.doc.lineAt(from - 1).text;
}

/** Whether what follows a line belongs to it. */
const opensBlock = (line: string): boolean =>
  /^\s*((init|eff|atomic|else)|(role|on|for)\b[^;=]*|(if|elif)\b(?!.*\bthen\b)[^;]*|function\b[^=]*|[A-Za-z_]\w*\(\))\s*(\/\/.*)?$/.test(
    line,
  );

function string(stream: StringStream, state: State): string {
  while (!stream.eol()) {
    const next = stream.next();
    if (next === "\\") stream.next();
    else if (next === '"') {
      state.inString = false;
      break;
    }
  }
  return "string";
}

function name(word: string, stream: StringStream, state: State): string {
  const { before } = state;
  const isFirst = /^\s*$/.test(stream.string.slice(0, stream.start));
  state.before = word;
  if (before === ".") return stream.peek() === "(" ? "propertyName.function" : "propertyName";
  if (NAMED.test(before))
    return /^(enum|record|message)$/.test(before) ? "typeName" : "variableName.definition";
  if (
    DECLARATIONS.has(word) &&
    (isFirst || word === "enum") &&
    !/^\s*[=:(.]/.test(stream.string.slice(stream.pos))
  ) {
    return "definitionKeyword";
  }
  if (word === "input" && before === "on") return "definitionKeyword";
  if (CONTROL.has(word)) return "controlKeyword";
  if (OPERATORS.has(word)) return "operatorKeyword";
  if (ATOMS.has(word)) return "bool";
  if (TYPES.has(word) || /^[A-Z]/.test(word)) return "typeName";
  if (OWN.has(word)) return "self";
  if (isFirst && /^\(\)\s*(\/\/.*)?$/.test(stream.string.slice(stream.pos))) return "variableName.definition";
  return stream.peek() === "(" ? "variableName.function" : "variableName";
}
