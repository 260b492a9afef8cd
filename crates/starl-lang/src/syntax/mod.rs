//! From text to a tree that holds every character of it.
