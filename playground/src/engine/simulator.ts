// The simulator's WebAssembly module, loaded and compiled once for all workers of the page. The page does both while
// its own code still loads; a worker would begin after its code has come.

import { moduleResponse } from "./module.ts";

let compiled: Promise<WebAssembly.Module> | null = null;

/** The module. If it could not be loaded, the next call tries again. */
export function simulator(): Promise<WebAssembly.Module> {
  compiled ??= compile().catch((error) => {
    compiled = null;
    throw error;
  });
  return compiled;
}

async function compile(): Promise<WebAssembly.Module> {
  const response = await moduleResponse();
  if (!response.ok) throw new Error(`${response.url}: ${response.status} ${response.statusText}`);
  // Compiled while it loads, unless the host does not name its type.
  if (/^application\/wasm\b/i.test(response.headers.get("content-type") ?? ""))
    return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}
