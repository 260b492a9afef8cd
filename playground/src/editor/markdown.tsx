// Shows the little Markdown that the simulator's texts use: headings, paragraphs, lists, code and emphasis. It makes
// elements and never takes text for HTML.

import type { ComponentChildren, JSX } from "preact";

export function Markdown({ text, heading = 3 }: { text: string; heading?: 3 | 4 }): JSX.Element {
  const Heading = `h${heading}` as const;
  return (
    <div class="markdown">
      {blocks(text).map((block, index) => {
        // The list is rebuilt for each text.
        const key = `${index}`;
        if (block.kind === "code") return <pre key={key}>{block.text}</pre>;
        if (block.kind === "heading") return <Heading key={key}>{inline(block.text)}</Heading>;
        if (block.kind === "rule") return <hr key={key} />;
        if (block.kind === "list") {
          return (
            <ul key={key}>
              {block.text.split("\n").map((item) => (
                <li key={item}>{inline(item)}</li>
              ))}
            </ul>
          );
        }
        return <p key={key}>{inline(block.text)}</p>;
      })}
    </div>
  );
}

export interface Block {
  kind: "code" | "heading" | "list" | "paragraph" | "rule";
  text: string;
}

export function blocks(text: string): Block[] {
  const found: Block[] = [];
  const lines = text.split("\n");
  for (let at = 0; at < lines.length; at++) {
    const line = lines[at] ?? "";
    if (line.startsWith("```")) {
      const end = lines.findIndex((other, index) => index > at && other.startsWith("```"));
      const last = end < 0 ? lines.length : end;
      found.push({ kind: "code", text: lines.slice(at + 1, last).join("\n") });
      at = last;
    } else if (/^#{1,6} /.test(line)) found.push({ kind: "heading", text: line.replace(/^#+ /, "") });
    else if (/^(-{3,}|\*{3,})$/.test(line)) found.push({ kind: "rule", text: "" });
    else if (/^[-*] /.test(line)) add(found, "list", line.slice(2), "\n");
    else if (line.trim() === "") found.push({ kind: "paragraph", text: "" });
    else if (/^ +/.test(line) && found.at(-1)?.kind === "list") add(found, "list", line.trim(), " ");
    else add(found, "paragraph", line, " ");
  }
  return found.filter(({ kind, text }) => kind === "rule" || text !== "");
}

function add(found: Block[], kind: Block["kind"], text: string, glue: string): void {
  const last = found.at(-1);
  if (last?.kind === kind && last.text !== "") last.text += glue + text;
  else found.push({ kind, text });
}

const PARTS = /(`[^`]+`|\*\*[^*]+\*\*|\*[^*\s][^*]*\*|\[[^\]]+\]\([^)]+\))/;

/** Links are shown as their text: their targets are not part of the page. */
function inline(text: string): ComponentChildren[] {
  return text.split(PARTS).map((part, index) => {
    const key = `${index}`;
    if (part.startsWith("`") && part.length > 1) return <code key={key}>{part.slice(1, -1)}</code>;
    if (part.startsWith("**") && part.length > 3)
      return <strong key={key}>{inline(part.slice(2, -2))}</strong>;
    if (part.startsWith("*") && part.endsWith("*") && part.length > 2)
      return <em key={key}>{part.slice(1, -1)}</em>;
    const link = /^\[([^\]]+)\]\(([^)]+)\)$/.exec(part);
    return link ? <span key={key}>{inline(link[1] ?? "")}</span> : part;
  });
}
