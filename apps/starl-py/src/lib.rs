//! The native module of the Python package `starl`: the simulator behind the requests in JSON that the page in a
//! browser also sends, and arrays and tables, which are too large for JSON.
//!
//! The classes that people use are written in Python, in `python/starl/`.

mod campaign;
mod engine;
mod env;
mod judge;
mod numbers;
mod robot;
mod sweep;
mod table;
mod trace;

use pyo3::prelude::*;

/// The native part of StarL. Use the package `starl` instead.
#[pymodule]
mod _native {
    /// The version of the package, which is that of the command.
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "it is a name of Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    use super::campaign::Campaign;
    #[pymodule_export]
    use super::engine::Engine;
    #[pymodule_export]
    use super::env::Batch;
    #[pymodule_export]
    use super::env::Judge;
    #[pymodule_export]
    use super::robot::Draws;
    #[pymodule_export]
    use super::robot::Handle;
    #[pymodule_export]
    use super::robot::Primitive;
    #[pymodule_export]
    use super::sweep::Sweep;
    #[pymodule_export]
    use super::table::Table;
    #[pymodule_export]
    use super::trace::Trace;
}
