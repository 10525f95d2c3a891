//! How many forms are looked at in a frame.

/// How many of the contacts that were there before have their forms looked at in a frame, in turn; those that
/// are new always have. One, if nothing else is asked for: a form costs as much as all the rest of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Forms(u8);

impl Forms {
    /// All in each frame.
    pub const ALL: Forms = Forms(0);

    /// So many in a frame; 0: all.
    pub const fn of(in_frame: u8) -> Forms {
        Forms(in_frame)
    }

    /// How many are looked at in a frame, at most.
    pub(super) const fn in_frame(self) -> usize {
        if self.0 == 0 { u16::MAX as usize } else { self.0 as usize }
    }
}

impl Default for Forms {
    fn default() -> Self {
        Forms(1)
    }
}
