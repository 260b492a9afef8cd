//! The tests of `starl-zenoh`, in one binary so that they link once.

mod network;
mod tls;
