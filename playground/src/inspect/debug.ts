// The state of primitives. The simulator gives it as Rust's `Debug` writes it; here it becomes fields, as the variables
// of a program are: without the names of Rust's types, times in seconds, robots by their names.

export interface Field {
  name: string;
  value: string;
}

type Node =
  | { kind: "text"; text: string }
  /** A struct or a variant, with named or numbered parts. */
  | { kind: "struct"; name: string; fields: [string, Node][] }
  | { kind: "tuple"; name: string; parts: Node[] }
  | { kind: "list"; parts: Node[] }
  | { kind: "map"; entries: [Node, Node | null][] };

type NameOf = (robot: number) => string;

/** Values that are nested deeper are shown as they are. */
const DEEPEST = 100;
/** These do not change during a run, and come last. */
const SETTINGS = new Set(["options"]);
const LEFT_OUT = new Set(["port"]);

/** The fields of a state. A text that cannot be parsed becomes one field without a name. */
export function fieldsOf(text: string, nameOf: NameOf): Field[] {
  let node: Node;
  try {
    node = new Reader(text).whole();
  } catch {
    return [{ name: "", value: text }];
  }
  node = unwrapped(node);
  if (node.kind !== "struct") return [{ name: "", value: show(node, nameOf) }];
  const fields = node.fields.filter(([name]) => !LEFT_OUT.has(name));
  const last = (name: string) => (SETTINGS.has(name) ? 1 : 0);
  fields.sort(([one], [other]) => last(one) - last(other));
  return fields.map(([name, value]) => ({
    name: name.replaceAll("_", " "),
    value: show(value, nameOf, name),
  }));
}

/** The content of boxes with one thing in them, such as `Acknowledged(Channel { .. })`. */
function unwrapped(node: Node): Node {
  const [only, another] = node.kind === "tuple" ? node.parts : [];
  if (only && !another && ["struct", "tuple"].includes(only.kind)) return unwrapped(only);
  return node;
}

function show(node: Node, nameOf: NameOf, field = ""): string {
  const inner = (node: Node) => show(node, nameOf);
  switch (node.kind) {
    case "text":
      return node.text === "None" ? "none" : node.text;
    case "list":
      return `[${node.parts.map(inner).join(", ")}]`;
    case "map":
      return `{${node.entries.map(([key, value]) => (value ? `${inner(key)}: ${inner(value)}` : inner(key))).join(", ")}}`;
    case "tuple": {
      const known = knownTuple(node, nameOf);
      if (known !== null) return known;
      const isOption = node.name === "Some";
      const parts = node.parts.map((part) => show(part, nameOf, isOption ? field : "")).join(", ");
      return isOption || isNamed(node.name, field) ? parts : `${node.name}(${parts})`;
    }
    case "struct": {
      const known = node.name === "Point" ? place(node.fields.map(([, value]) => value)) : null;
      if (known !== null) return known;
      const fields = node.fields
        .filter(([name]) => !LEFT_OUT.has(name))
        .map(([name, value]) => `${name}: ${show(value, nameOf, name)}`)
        .join(", ");
      return `${isNamed(node.name, field) ? "" : `${node.name} `}{${fields}}`;
    }
  }
}

/** Whether a name only repeats that of the field: `command: Command`. */
const isNamed = (type: string, field: string): boolean =>
  type.toLowerCase() === field.replaceAll("_", "").toLowerCase();

function knownTuple({ name, parts }: Node & { kind: "tuple" }, nameOf: NameOf): string | null {
  const [only, another] = parts;
  if (only?.kind !== "text" || another) return null;
  const number = Number(only.text);
  if (!Number.isFinite(number)) return null;
  switch (name) {
    case "Duration":
    case "Time":
      return `${Number((number / 1e9).toFixed(6))} s`;
    case "RobotId":
      return nameOf(number);
    case "Port":
      return `port ${only.text}`;
    default:
      return null;
  }
}

function place(parts: Node[]): string | null {
  const numbers = parts.map((part) => (part.kind === "text" ? Number(part.text) : Number.NaN));
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) return null;
  return `(${numbers.map((number) => number.toFixed(3)).join(", ")})`;
}

/** Reads one value. Throws if the text is not a complete value. */
class Reader {
  #at = 0;
  #depth = 0;

  constructor(private readonly text: string) {}

  whole(): Node {
    const node = this.#value();
    this.#space();
    if (this.#at < this.text.length) throw new Error("more than one value");
    return node;
  }

  #value(): Node {
    if (++this.#depth > DEEPEST) throw new Error("nested too deep");
    this.#space();
    const char = this.text[this.#at] ?? "";
    const node =
      char === "["
        ? this.#list()
        : char === "{"
          ? this.#map()
          : char === "("
            ? this.#tuple("")
            : this.#named();
    this.#depth--;
    return node;
  }

  #named(): Node {
    const text = this.#word(/"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)+'|[^\s,:(){}[\]"']+/y);
    const isName = /^[A-Za-z_]\w*$/.test(text);
    this.#space();
    if (isName && this.text[this.#at] === "(") return this.#tuple(text);
    if (isName && this.text[this.#at] === "{") return this.#struct(text);
    return { kind: "text", text };
  }

  #list(): Node {
    const parts: Node[] = [];
    this.#group("[", "]", () => parts.push(this.#value()));
    return { kind: "list", parts };
  }

  #tuple(name: string): Node {
    const parts: Node[] = [];
    this.#group("(", ")", () => parts.push(this.#value()));
    return { kind: "tuple", name, parts };
  }

  #struct(name: string): Node {
    const fields: [string, Node][] = [];
    this.#group("{", "}", () => {
      // Omitted fields.
      if (this.#take("..")) return;
      const field = this.#word(/[A-Za-z_]\w*/y);
      this.#expect(":");
      fields.push([field, this.#value()]);
    });
    return { kind: "struct", name, fields };
  }

  #map(): Node {
    const entries: [Node, Node | null][] = [];
    this.#group("{", "}", () => {
      const key = this.#value();
      entries.push([key, this.#take(":") ? this.#value() : null]);
    });
    return { kind: "map", entries };
  }

  #group(open: string, close: string, part: () => void): void {
    this.#expect(open);
    while (!this.#take(close)) {
      part();
      if (this.#take(",")) continue;
      this.#expect(close);
      return;
    }
  }

  #take(mark: string): boolean {
    this.#space();
    if (!this.text.startsWith(mark, this.#at)) return false;
    this.#at += mark.length;
    return true;
  }

  #expect(mark: string): void {
    if (!this.#take(mark)) throw new Error(`no ${mark} at ${this.#at}`);
  }

  #word(pattern: RegExp): string {
    this.#space();
    pattern.lastIndex = this.#at;
    const [text] = pattern.exec(this.text) ?? [];
    if (!text) throw new Error(`no value at ${this.#at}`);
    this.#at += text.length;
    return text;
  }

  #space(): void {
    while (this.text[this.#at] === " ") this.#at++;
  }
}
