// The data in the file of the embedded page.

/** The bytes in an element of the file, packed with gzip and in base 64; empty if there are none. */
export async function held(id: string): Promise<Blob> {
  const text = document.getElementById(id)?.textContent?.trim() ?? "";
  if (text === "") return new Blob();
  const packed = new Blob([Uint8Array.from(atob(text), (byte) => byte.charCodeAt(0))]);
  return new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).blob();
}
