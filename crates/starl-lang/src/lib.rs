//! The StarL language.
//!
//! The [`machine`] runs compiled programs, on a [`robot`] with its primitives. These two modules do not need the
//! standard library, so that a microcontroller can run programs that were compiled elsewhere. Everything else needs the
//! feature `compiler`, which is on by default.
#![cfg_attr(
    feature = "compiler",
    doc = "
A program is read by [`syntax`] into a tree that holds every character of the source, and a problem anywhere
is a [`diagnostic`]; reading never fails. [`check`] resolves names and types and gives the [`ir`], from which
[`compile`] makes bytecode. Tools for authors of programs are in the crate `starl-editor`."
)]
#![no_std]

extern crate alloc;
#[cfg(feature = "compiler")]
extern crate std;

#[cfg(feature = "compiler")]
pub mod check;
#[cfg(feature = "compiler")]
pub mod compile;
#[cfg(feature = "compiler")]
pub mod diagnostic;
#[cfg(feature = "compiler")]
pub mod ir;
pub mod machine;
pub mod robot;
#[cfg(feature = "compiler")]
pub mod syntax;
