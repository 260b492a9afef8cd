//! Bounds the memory of the module, so that no program can use all memory of the machine.

/// The memory of an instance, bytes: `MOST_MEMORY` of starl.mjs.
const MOST_MEMORY: u64 = 1 << 30;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let target = std::env::var("CARGO_CFG_TARGET_FAMILY");
    if target.is_ok_and(|family| family == "wasm") {
        println!("cargo::rustc-cdylib-link-arg=--max-memory={MOST_MEMORY}");
    }
}
