// Reads the Python files of tasks for the gallery.

export interface Task {
  name: string;
  /** One sentence. */
  summary: string;
  /** Rewards and ends. */
  rules: string;
  /** The class without its documentation. */
  code: string;
}

/** Reads a file of `starl.env.tasks`: a documentation of one line, then a class with a documentation. */
export function taskOf(source: string): Task {
  const summary = /^"""\w+(?: with \w+)?: ([\s\S]*?)"""/.exec(source)?.[1] ?? "";
  const found = /^class (\w+)\(.*\):\n {4}"""([\s\S]*?)"""\n\n([\s\S]*)/m.exec(source);
  if (!found) throw new Error(`no task: ${source.slice(0, 80)}`);
  const [, name = "", rules = "", body = ""] = found;
  const head = found[0].slice(0, found[0].indexOf("\n") + 1);
  return {
    name,
    summary: summary.charAt(0).toUpperCase() + summary.slice(1),
    rules: rules.replace(/\s+/g, " "),
    code: `${head}${body.trimEnd()}`,
  };
}
