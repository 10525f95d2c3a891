//! Number of forms measured in a frame.

/// Number of held contacts whose form is measured in a frame, in turn; that of new contacts always is. A scene
/// has one by default: a form costs as much as all the rest of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Forms(u8);

impl Forms {
    /// All contacts in each frame.
    pub const ALL: Forms = Forms(0);

    /// Makes a number of `in_frame` contacts in a frame; 0 stands for all.
    pub const fn of(in_frame: u8) -> Forms {
        Forms(in_frame)
    }

    /// Greatest number of held contacts that have their turn in a frame.
    pub(crate) const fn in_frame(self) -> usize {
        if self.0 == 0 { u16::MAX as usize } else { self.0 as usize }
    }
}
