//! Feedback from one frame's contacts to the next frame.

use super::consensus::DriftPace;
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
    /// True if it may be nothing but drift: it never rose faster.
    pub slow: bool,
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

    /// Sets where contacts hold the baseline and whether they may be drift, given their boxes in their home
    /// panels and their peaks: a part beyond a seam has the peak of its contact. What lies in another panel
    /// than the box that holds may be drift.
    pub(crate) fn hold(&mut self, contacts: impl Iterator<Item = (Rect, u16, (Rect, bool))> + Clone) {
        let set = |held: &mut Pressed, (rect, slow): (Rect, bool)| match rect.panel == held.rect.panel {
            true => (held.rect, held.slow) = (rect, slow),
            false => held.slow = true,
        };
        for held in &mut self.home {
            if let Some((.., hold)) = contacts.clone().find(|(rect, ..)| *rect == held.rect) {
                set(held, hold);
            }
        }
        for held in &mut self.beyond {
            if let Some((.., hold)) = contacts.clone().find(|(_, peak, _)| *peak == held.peak) {
                set(held, hold);
            }
        }
    }

    /// True if a taxel lies within one taxel of a contact.
    pub fn holds(&self, panel: u8, row: u16, column: u16) -> bool {
        self.touches(panel, row, column, column)
    }

    /// True if a taxel that shows `shown` counts lies within one taxel of a contact that holds its baseline.
    /// While its panel drifts fast, a contact that may be drift holds nothing, and any other one what shows a
    /// sixteenth of its peak.
    pub(crate) fn presses(&self, panel: u8, row: u16, column: u16, shown: u16, pace: DriftPace) -> bool {
        let near = |held: &&Pressed| held.rect.holds(panel, row, column, 1);
        let holds = |held: &Pressed| pace != DriftPace::Fast || !held.slow && shown >= held.peak / 16;
        self.home.iter().chain(&self.beyond).filter(near).any(holds)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drift_is_held_by_no_contact_that_may_be_drift() {
        let rect = |panel, left, right| Rect { panel, top: 2, bottom: 4, left, right };
        let mut feedback = Feedback::<4>::new();
        feedback.home.push(Pressed { rect: rect(0, 2, 9), peak: 160, slow: false }).unwrap();
        feedback.beyond.push(Pressed { rect: rect(1, 0, 3), peak: 160, slow: false }).unwrap();
        let held = |feedback: &Feedback<4>, panel, column, shown| {
            [DriftPace::Still, DriftPace::Slow, DriftPace::Fast]
                .map(|pace| feedback.presses(panel, 3, column, shown, pace))
        };
        assert_eq!(held(&feedback, 0, 9, 10), [true; 3]);
        assert_eq!(held(&feedback, 0, 9, 9), [true, true, false]);
        assert_eq!(held(&feedback, 0, 11, 160), [false; 3]);
        // The box of its onset holds, and nothing in another panel.
        feedback.hold([(rect(0, 2, 9), 160, (rect(0, 2, 5), false))].into_iter());
        assert_eq!([6, 7].map(|column| held(&feedback, 0, column, 160)), [[true; 3], [false; 3]]);
        assert_eq!(held(&feedback, 1, 1, 160), [true, true, false]);
        feedback.hold([(rect(0, 2, 5), 160, (rect(0, 2, 5), true))].into_iter());
        assert_eq!(held(&feedback, 0, 3, 160), [true, true, false]);
    }
}
