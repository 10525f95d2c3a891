//! What one frame's contacts tell the next frame.

use crate::garment::Rect;
use heapless::Vec;

/// Most rectangles of contacts that reach across a seam into another panel.
pub const CARRIED: usize = 16;

/// The rectangles of the last frame's contacts: there the baseline stands still, and a weak contact is kept.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Feedback<const CONTACTS: usize> {
    /// In each contact's home panel.
    pub home: Vec<Rect, CONTACTS>,
    /// Its parts beyond a seam.
    pub beyond: Vec<Rect, CARRIED>,
}

impl<const CONTACTS: usize> Feedback<CONTACTS> {
    /// Nothing touches.
    pub const fn new() -> Self {
        Feedback { home: Vec::new(), beyond: Vec::new() }
    }

    /// Whether a contact is on a panel.
    pub fn is_on(&self, panel: u8) -> bool {
        self.home.iter().chain(&self.beyond).any(|rect| rect.panel == panel)
    }

    /// Whether a taxel lies within one taxel of a contact.
    pub fn holds(&self, panel: u8, row: u16, column: u16) -> bool {
        self.touches(panel, row, column, column)
    }

    /// A bit for each of the columns `first .. first + 32` of a row that lie within one taxel of a contact.
    pub fn held_columns(&self, panel: u8, row: u16, first: u16) -> u32 {
        let mut held = 0;
        for rect in self.home.iter().chain(&self.beyond) {
            let (left, end) = (rect.left.saturating_sub(1), rect.right.saturating_add(2));
            let here = rect.panel == panel
                && row.saturating_add(1) >= rect.top
                && row <= rect.bottom.saturating_add(1);
            if here && end > first && left < first.saturating_add(32) {
                let columns = (end - first).min(32) - left.saturating_sub(first);
                held |= (u32::MAX >> (32 - u32::from(columns))) << left.saturating_sub(first);
            }
        }
        held
    }

    /// Whether columns `left ..= right` of a row come within one taxel of a contact.
    pub fn touches(&self, panel: u8, row: u16, left: u16, right: u16) -> bool {
        self.home.iter().chain(&self.beyond).any(|rect| {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn held_columns_are_those_that_are_held() {
        let mut feedback = Feedback::<8>::new();
        for (left, right) in [(0, 0), (5, 9), (30, 33), (62, 63), (40, 100)] {
            let rect = Rect { panel: 1, top: 4, bottom: 6, left, right };
            feedback.home.clear();
            feedback.home.push(rect).unwrap();
            for (panel, row) in [(0, 5), (1, 2), (1, 3), (1, 6), (1, 7), (1, 8)] {
                for first in [0, 8, 16, 24, 32, 60] {
                    let mask = feedback.held_columns(panel, row, first);
                    for bit in 0..32 {
                        assert_eq!(mask >> bit & 1 == 1, feedback.holds(panel, row, first + bit), "{rect:?}");
                    }
                }
            }
        }
    }
}
