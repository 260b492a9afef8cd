// From where workers load the WebAssembly module. The embedded page has module.embedded.ts instead of this.

import wasm from "../../wasm/starl.wasm?url";

export const moduleSource = async () => new URL(wasm, self.location.href);
