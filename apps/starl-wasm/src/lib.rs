//! The simulator for JavaScript and other hosts of WebAssembly.
//!
//! The exports of the module are the plain C interface of a [`Service`](starl_catalog::service::Service), which
//! `starl.mjs` wraps for JavaScript; `docs/reference/javascript.md` describes that.

#[cfg(target_family = "wasm")]
mod exports;
