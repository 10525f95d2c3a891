//! Feedback from one frame's contacts to the next frame.

use crate::garment::Rect;
use heapless::Vec;

/// Most rectangles of contacts that extend across a seam into another panel.
pub const CARRIED: usize = 16;

/// A contact of the last frame, or its part beyond a seam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pressed {
    /// Bounding rectangle.
    pub rect: Rect,
    /// Greatest pressure of the contact, counts.
    pub peak: u16,
}

/// The last frame's contacts: under them the baseline does not follow the codes, and a weak contact is kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feedback<const CONTACTS: usize> {
    /// Each contact's part in its home panel.
    pub home: Vec<Pressed, CONTACTS>,
    /// Parts beyond a seam.
    pub beyond: Vec<Pressed, CARRIED>,
}

impl<const CONTACTS: usize> Feedback<CONTACTS> {
    /// No contacts.
    pub const fn new() -> Self {
        Feedback { home: Vec::new(), beyond: Vec::new() }
    }

    /// True if a taxel lies within one taxel of a contact.
    pub fn holds(&self, panel: u8, row: u16, column: u16) -> bool {
        self.touches(panel, row, column, column)
    }

    /// True if a taxel that shows `shown` counts lies within one taxel of a contact and shows at least a
    /// sixteenth of that contact's peak.
    pub fn presses(&self, panel: u8, row: u16, column: u16, shown: u16) -> bool {
        let near = |held: &&Pressed| held.rect.holds(panel, row, column, 1);
        self.home.iter().chain(&self.beyond).filter(near).any(|held| shown >= held.peak / 16)
    }

    /// True if columns `left ..= right` of a row come within one taxel of a contact.
    pub fn touches(&self, panel: u8, row: u16, left: u16, right: u16) -> bool {
        self.home.iter().chain(&self.beyond).any(|Pressed { rect, .. }| {
            rect.panel == panel
                && row.saturating_add(1) >= rect.top
                && row <= rect.bottom.saturating_add(1)
                && right.saturating_add(1) >= rect.left
                && left <= rect.right.saturating_add(1)
        })
    }
}

impl<const CONTACTS: usize> Default for Feedback<CONTACTS> {
    fn default() -> Self {
        Feedback::new()
    }
}
