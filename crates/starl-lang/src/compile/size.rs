//! How many registers values take.

/// The most registers that a value may take.
pub(super) const WIDEST: Size = Size::new(255, 127);

/// How many registers of each kind something takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Size {
    /// Scalar registers.
    pub scalars: u32,
    /// Object registers.
    pub objects: u32,
}

impl Size {
    pub const NONE: Self = Self::new(0, 0);
    pub const SCALAR: Self = Self::new(1, 0);
    pub const OBJECT: Self = Self::new(0, 1);

    pub const fn new(scalars: u32, objects: u32) -> Self {
        Self { scalars, objects }
    }

    pub const fn plus(self, other: Self) -> Self {
        Self {
            scalars: self.scalars.saturating_add(other.scalars),
            objects: self.objects.saturating_add(other.objects),
        }
    }

    /// Whether a value may have this size.
    pub const fn fits(self) -> bool {
        self.scalars <= WIDEST.scalars && self.objects <= WIDEST.objects
    }

    /// As many of each as the greater of the two.
    pub fn max(self, other: Self) -> Self {
        Self {
            scalars: self.scalars.max(other.scalars),
            objects: self.objects.max(other.objects),
        }
    }
}
