//! The machine that runs compiled programs.
