// The pages of the reference of errors, by code. Loaded when the first is asked for.

const files: Record<string, string> = import.meta.glob("../../../docs/errors/[EW]*.md", {
  query: "?raw",
  import: "default",
  eager: true,
});

export const pages: Record<string, string> = Object.fromEntries(
  Object.entries(files).map(([path, text]) => [path.replace(/^.*\/|\.md$/g, ""), text]),
);
