// Where the module is: `make wasm-module` puts it where the page takes it from.

export const moduleFile = new URL("../../../playground/wasm/starl.wasm", import.meta.url).pathname;
