//! The simulator for JavaScript and other hosts of WebAssembly.
//!
//! A [`Host`] holds simulations and answers requests in JSON. The exports of the module are its plain C interface, which
//! `starl.mjs` wraps for JavaScript; `docs/reference/javascript.md` describes that.

#[cfg(target_family = "wasm")]
mod exports;
mod host;
mod request;

pub use host::Host;
