//! Laying a program out in the one canonical way.
