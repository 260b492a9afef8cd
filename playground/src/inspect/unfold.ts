// Long texts of nested values, broken into lines so that people can read them.

/** Values that fit into a line stay in one. */
const WIDTH = 46;
const CLOSING: Record<string, string> = { "{": "}", "[": "]", "(": ")" };

export function unfold(text: string, indent = 0): string {
  const pad = "  ".repeat(indent);
  let out = "";
  for (let at = 0; at < text.length; at++) {
    const char = text.charAt(at);
    if (char === '"') {
      const end = endOfText(text, at);
      out += text.slice(at, end);
      at = end - 1;
      continue;
    }
    if (!(char in CLOSING)) {
      out += char;
      continue;
    }
    const end = endOfGroup(text, at);
    const inner = text.slice(at + 1, end - 1).trim();
    if (inner.length <= WIDTH) out += text.slice(at, end);
    else {
      const parts = split(inner).map((part) => `${pad}  ${unfold(part.trim(), indent + 1)}`);
      out += `${char}\n${parts.join(",\n")}\n${pad}${CLOSING[char]}`;
    }
    at = end - 1;
  }
  return out;
}

function endOfText(text: string, from: number): number {
  let at = from + 1;
  while (at < text.length && text[at] !== '"') at += text[at] === "\\" ? 2 : 1;
  return Math.min(text.length, at + 1);
}

function endOfGroup(text: string, from: number): number {
  let depth = 0;
  for (let at = from; at < text.length; at++) {
    const char = text.charAt(at);
    if (char === '"') at = endOfText(text, at) - 1;
    else if (char in CLOSING) depth++;
    else if ("}])".includes(char) && --depth === 0) return at + 1;
  }
  return text.length;
}

/** The parts between commas that are in no group of their own. */
function split(text: string): string[] {
  const parts = [];
  let start = 0;
  for (let at = 0; at < text.length; at++) {
    const char = text.charAt(at);
    if (char === '"') at = endOfText(text, at) - 1;
    else if (char in CLOSING) at = endOfGroup(text, at) - 1;
    else if (char === ",") {
      parts.push(text.slice(start, at));
      start = at + 1;
    }
  }
  parts.push(text.slice(start));
  return parts.filter((part) => part.trim() !== "");
}
