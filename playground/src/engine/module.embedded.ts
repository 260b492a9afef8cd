// From where workers of the embedded page load the WebAssembly module: their name is a data address of its bytes, packed
// with gzip; see build/embedded.ts.

export async function moduleSource(): Promise<ArrayBuffer> {
  if (!self.name) throw new Error("this page shows a recorded run and cannot simulate it");
  const { body } = await fetch(self.name);
  return new Response(body?.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
