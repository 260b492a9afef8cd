//! Devices, real and emulated.

use starl_node::motors::PositionSource;

/// A robot's device, and the source of its positions.
pub type Hardware = (Box<dyn starl_node::Device>, Option<Box<dyn PositionSource>>);

/// Something that is emulated as long as this is there.
pub struct Emulated {
    /// Where it is.
    pub text: String,
    pub _device: Box<dyn std::any::Any>,
}
