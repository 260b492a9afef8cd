// Where the module is: in $CARGO_TARGET_DIR, or else in target/.

const target = process.env.CARGO_TARGET_DIR ?? new URL("../../../target", import.meta.url).pathname;

export const moduleFile = `${target}/wasm32-unknown-unknown/page/starl_wasm.wasm`;
