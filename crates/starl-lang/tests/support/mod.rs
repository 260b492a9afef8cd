//! What tests and fuzz targets of whole programs share: programs, a world for them, and what must hold.
#![allow(dead_code, reason = "each test uses a part")]

pub mod compare;
pub mod generate;
pub mod hold;
pub mod reference;
pub mod run;
pub mod world;
