// Where the embedded page has the WebAssembly module: in an element of its file, packed with gzip and in base 64; see
// build/embedded.ts.

import { held } from "../held.ts";

export async function moduleResponse(): Promise<Response> {
  const content = await held("starl-module");
  if (content.size === 0) throw new Error("this page shows a recorded run and cannot simulate it");
  return new Response(content, { headers: { "content-type": "application/wasm" } });
}
