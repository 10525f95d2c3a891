//! What touches a board: a contact, or what is too faint to be one.

use super::seam_change::SeamChange;
use taxel_core::contact::{Contact, Phase};
use taxel_core::garment::{Place, Rect};

/// Connected taxels of a board that are touched.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardTouch {
    /// Id of the contact; none if it is too faint to be one on its board.
    pub contact: Option<u32>,
    /// The contact has just begun.
    pub begins: bool,
    /// Index of the panel.
    pub panel: u8,
    /// Sum of the pressure, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// Number of taxels.
    pub area: u16,
    /// Box of its taxels on the panel.
    pub bounds: Rect,
    /// Centroid, `[x, y]` in taxels of the panel.
    pub centroid: [f64; 2],
    /// Velocity of the centroid, taxels per second.
    pub velocity: [f64; 2],
    /// Newtons per count of the total; none without a calibration in force.
    pub newtons_per_count: Option<f64>,
}

/// Pressure and place of a touch at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchMoment {
    /// Its total, counts.
    pub total: f64,
    /// Its centroid, `[x, y]` in taxels of its panel.
    pub centroid: [f64; 2],
}

impl From<&Contact> for BoardTouch {
    fn from(contact: &Contact) -> BoardTouch {
        BoardTouch {
            contact: Some(contact.id),
            begins: contact.phase == Phase::Onset,
            panel: contact.panel,
            total: contact.total,
            peak: contact.peak,
            area: contact.area,
            bounds: contact.bounds,
            centroid: [contact.x, contact.y].map(|place| place.to_f64()),
            velocity: [contact.vx, contact.vy].map(|speed| speed.to_f64()),
            newtons_per_count: None,
        }
    }
}

impl BoardTouch {
    /// True if a taxel is in its box, or at most `beside` taxels from it.
    pub fn reaches(&self, place: Place, beside: u16) -> bool {
        let Rect { panel, top, bottom, left, right } = self.bounds;
        let is_near = |at: u16, first: u16, last: u16| {
            at.saturating_add(beside) >= first && at <= last.saturating_add(beside)
        };
        place.panel == panel && is_near(place.row, top, bottom) && is_near(place.column, left, right)
    }

    /// Its pressure and place.
    pub fn moment(&self) -> TouchMoment {
        TouchMoment { total: self.total.into(), centroid: self.centroid }
    }

    /// Takes a taxel as it is with what presses beyond the seam.
    pub fn change(&mut self, change: &SeamChange) {
        let SeamChange { place: Place { row, column, .. }, told, value, .. } = *change;
        let (before, added) = (f64::from(self.total), f64::from(value) - f64::from(told));
        let total = (before + added).max(1.0);
        for (centroid, at) in self.centroid.iter_mut().zip([column, row]) {
            *centroid += (f64::from(at) - *centroid) * added / total;
        }
        self.total = total as u32;
        self.peak = self.peak.max(value);
        self.area = self.area.saturating_add((told == 0).into());
        (self.bounds.top, self.bounds.bottom) = (self.bounds.top.min(row), self.bounds.bottom.max(row));
        (self.bounds.left, self.bounds.right) = (self.bounds.left.min(column), self.bounds.right.max(column));
    }

    /// True if at most one taxel lies between the boxes of the two, which are on the same board.
    pub fn is_beside(&self, other: &BoardTouch) -> bool {
        let (a, b) = (self.bounds, other.bounds);
        self.panel == other.panel
            && a.top <= b.bottom + 2
            && b.top <= a.bottom + 2
            && a.left <= b.right + 2
            && b.left <= a.right + 2
    }
}
