//! Zenoh as the network of a fleet (Eclipse Zenoh, <https://zenoh.io>).
