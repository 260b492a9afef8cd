// Gives the user a file that was made on the page.

export function download(name: string, type: string, content: string | Blob): void {
  const url = URL.createObjectURL(typeof content === "string" ? new Blob([content], { type }) : content);
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  // Chrome reads the file after the click.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** A name for a file that every system takes. */
export const fileName = (name: string): string =>
  name.replace(/[^\p{L}\p{N}_-]+/gu, "-").replace(/^-+|-+$/g, "") || "starl";
