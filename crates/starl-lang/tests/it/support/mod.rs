//! What tests and fuzz targets of whole programs share: programs, a world for them, and what must hold.

pub mod compare;
pub mod generate;
pub mod hold;
pub mod reference;
pub mod run;
pub mod world;
