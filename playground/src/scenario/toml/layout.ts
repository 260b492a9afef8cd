// Where things stand in a TOML text, so that single values can be replaced and all else stays as it was written. Values
// are read elsewhere (smol-toml); here only their places count.

export type Path = (string | number)[];

/** A value: from its first character to after its last. */
export interface Value {
  from: number;
  to: number;
  kind: "scalar" | "array" | "table";
  /** Of an array, in their order. */
  items: Value[];
  /** Of an inline table. */
  entries: Entry[];
}

/** `key = value`. */
export interface Entry {
  /** From the key to the end of the value. */
  from: number;
  to: number;
  /** From the root of the document, or from the inline table that it stands in. */
  path: Path;
  value: Value;
}

/** The content under one header; the first section has none. */
export interface Section {
  /** With numbers for the elements of arrays. */
  path: Path;
  /** The header's line, its end without the line break. */
  from: number;
  to: number;
  entries: Entry[];
}

export class Layout {
  readonly sections: Section[] = [{ path: [], from: 0, to: 0, entries: [] }];
  #at = 0;
  #counts = new Map<string, number>();

  /** Throws if the text is not TOML; but not every such text is found. */
  constructor(readonly text: string) {
    for (this.#space(); this.#at < text.length; this.#space()) {
      if (text[this.#at] === "[") this.#header();
      else this.section.entries.push(this.#entry(this.section.path));
    }
  }

  /** The last section so far. */
  get section(): Section {
    return this.sections[this.sections.length - 1] as Section;
  }

  /** The value at a path that stands in one place; tables with headers do not. */
  find(path: Path): Value | null {
    return this.entry(path)?.value ?? null;
  }

  /** The value at a path with what it stands in. */
  entry(path: Path): { value: Value; entry: Entry | null; owner: Section | Value } | null {
    for (const section of this.sections) {
      if (!isPrefix(section.path, path)) continue;
      for (const entry of section.entries) {
        if (!isPrefix(entry.path, path)) continue;
        const found = descend(entry.value, path.slice(entry.path.length));
        if (found)
          return found.owner
            ? { ...found, owner: found.owner }
            : { value: entry.value, entry, owner: section };
      }
    }
    return null;
  }

  #header(): void {
    const from = this.#at;
    const isArray = this.text.startsWith("[[", from);
    this.#at += isArray ? 2 : 1;
    const path = this.#indexed(this.#key(), isArray);
    this.#expect(isArray ? "]]" : "]");
    this.sections.push({ path, from, to: this.#at, entries: [] });
  }

  /** The path of a header: it speaks of the last element of each array. */
  #indexed(names: string[], isArray: boolean): Path {
    const path: Path = [];
    for (const [index, name] of names.entries()) {
      path.push(name);
      const key = JSON.stringify(path);
      const count = this.#counts.get(key);
      const isLast = index === names.length - 1;
      if (isLast && isArray) {
        this.#counts.set(key, (count ?? 0) + 1);
        path.push(count ?? 0);
      } else if (count !== undefined) path.push(count - 1);
    }
    return path;
  }

  #entry(before: Path): Entry {
    const from = this.#at;
    const path = [...before, ...this.#key()];
    this.#blank();
    this.#expect("=");
    this.#blank();
    const value = this.#value();
    return { from, to: value.to, path, value };
  }

  #key(): string[] {
    const parts: string[] = [];
    do {
      this.#blank();
      const rest = this.text.slice(this.#at);
      const [part] = /^([A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*')/.exec(rest) ?? this.#fail("a key");
      this.#at += part.length;
      parts.push(part.startsWith('"') ? JSON.parse(part) : part.replaceAll("'", ""));
      this.#blank();
    } while (this.#eat("."));
    return parts;
  }

  #value(): Value {
    const from = this.#at;
    const value: Value = { from, to: from, kind: "scalar", items: [], entries: [] };
    if (this.#eat("[")) {
      value.kind = "array";
      this.#list("]", () => value.items.push(this.#value()));
    } else if (this.#eat("{")) {
      value.kind = "table";
      this.#list("}", () => value.entries.push(this.#entry([])));
    } else {
      const [scalar] = SCALAR.exec(this.text.slice(from)) ?? this.#fail("a value");
      this.#at += scalar.trimEnd().length;
    }
    value.to = this.#at;
    return value;
  }

  #list(end: string, take: () => void): void {
    for (this.#space(); !this.#eat(end); this.#space()) {
      take();
      this.#space();
      if (!this.#eat(",") && this.text[this.#at] !== end) this.#fail(`, or ${end}`);
    }
  }

  #eat(text: string): boolean {
    const here = this.text.startsWith(text, this.#at);
    if (here) this.#at += text.length;
    return here;
  }

  #expect(text: string): void {
    if (!this.#eat(text)) this.#fail(text);
  }

  #fail(what: string): never {
    throw new Error(`${what} is missing at ${this.#at}`);
  }

  #blank(): void {
    while (this.text[this.#at] === " " || this.text[this.#at] === "\t") this.#at++;
  }

  /** Blanks, line ends and comments. */
  #space(): void {
    const [space] = /^(?:\s|#[^\n]*)*/.exec(this.text.slice(this.#at)) ?? [""];
    this.#at += space.length;
  }
}

const SCALAR = /^("""[\s\S]*?"""+|'''[\s\S]*?'''+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'|[^\s,\]}#"'][^,\]}#\n]*)/;

export const isPrefix = (start: Path, path: Path): boolean =>
  start.length <= path.length && start.every((part, index) => part === path[index]);

interface Found {
  value: Value;
  entry: Entry | null;
  owner: Value | null;
}

function descend(value: Value, rest: Path): Found | null {
  const [first] = rest;
  if (first === undefined) return { value, entry: null, owner: null };
  if (typeof first === "number") {
    const item = value.items[first];
    if (!item) return null;
    const found = descend(item, rest.slice(1));
    return found && (found.owner ? found : { ...found, owner: value });
  }
  for (const entry of value.entries) {
    if (!isPrefix(entry.path, rest)) continue;
    const found = descend(entry.value, rest.slice(entry.path.length));
    if (found) return found.owner ? found : { ...found, entry, owner: value };
  }
  return null;
}
