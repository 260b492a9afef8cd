// Where the page loads the WebAssembly module from. The embedded page has module.embedded.ts instead of this.

import wasm from "../../wasm/starl.wasm?url";

export const moduleResponse = (): Promise<Response> => fetch(wasm);
