//! Common code of the tests and fuzz targets of whole programs: programs, a world for them, and their properties.

pub mod compare;
pub mod generate;
pub mod hold;
pub mod reference;
pub mod run;
pub mod world;
