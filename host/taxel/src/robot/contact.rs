//! A contact of a board, with its force if a calibration is in force.

use taxel_core::contact::Contact;
use taxel_core::garment::Rect;

/// A contact of a board.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardContact {
    /// Id on the board.
    pub id: u32,
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

impl From<&Contact> for BoardContact {
    fn from(contact: &Contact) -> BoardContact {
        BoardContact {
            id: contact.id,
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
