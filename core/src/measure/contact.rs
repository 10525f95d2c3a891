//! Public record of a contact.

use crate::format::{Fixed16, Micros, Q15, Turn};
use crate::garment::{Place, Rect};
use serde::{Deserialize, Serialize};

/// Phase of a contact's life.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// First frame of the contact.
    #[default]
    Onset,
    /// Contact that was there in the previous frame.
    Held,
    /// Contact that is gone: the values are the last ones, the total is 0. Reported once.
    Released,
}

/// One contact in one frame. Coordinates are taxels of its home panel, the one with most of its mass; a part
/// beyond a seam continues them past the border.
///
/// Pressure, area, place and motion are those of the frame. The form (`perimeter`, `edge`, `azimuth`,
/// `anisotropy`, `breadth`) is measured in the first frame, and from then on when it is the contact's turn:
/// [`Forms`](crate::contact::Forms) contacts have their turn in a frame. With one turn a frame, the form of a
/// single contact is always that of the frame, and the forms of five contacts are at most four frames old.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Contact {
    /// Number of its onset, from 1 upwards; constant from onset to release.
    pub id: u32,
    /// Onset, held or released.
    pub phase: Phase,
    /// Index of its home panel.
    pub panel: u8,
    /// Sum of the pressure, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// First taxel with that pressure; may be on another panel if the contact crosses a seam.
    pub peak_at: Place,
    /// Number of taxels.
    pub area: u16,
    /// Number of taxels with at least one of the four neighbours below the low threshold or outside the
    /// panel.
    pub perimeter: u16,
    /// Mean slope over those taxels, counts per taxel (Sobel magnitude / 8); saturates.
    pub edge: u16,
    /// Bounding box of its taxels in the home panel.
    pub bounds: Rect,
    /// Centroid, column (eq. 1 and 2, from 0), rounded once: half a step off at most.
    pub x: Fixed16,
    /// Centroid, row; rounded like `x`.
    pub y: Fixed16,
    /// Direction of the major axis, see [`Axis`](crate::contact::Axis); none if the contact has no clear
    /// direction.
    pub azimuth: Option<Turn>,
    /// Elongation: 0 for a disc or square, 1 for a line.
    pub anisotropy: Q15,
    /// Width across the major axis in 0.1 mm, see [`breadth`](crate::contact::breadth); 10 mm pitch is
    /// assumed if the panel gives none.
    pub breadth: u32,
    /// Displacement since onset along x, of the centroid or of the pattern inside, taxels. It follows the
    /// contact across seams. The jumps of merging and splitting do not count.
    pub dx: Fixed16,
    /// Displacement since onset along y.
    pub dy: Fixed16,
    /// Smoothed velocity along x, taxels per second.
    pub vx: Fixed16,
    /// Smoothed velocity along y.
    pub vy: Fixed16,
    /// True while it slips: see the [module](crate::contact).
    pub slip: bool,
    /// Time of its first frame.
    pub onset: Micros,
    /// Time since onset, ms.
    pub duration_ms: u32,
    /// Greatest total since onset.
    pub peak_total: u32,
    /// Breadth at the greatest total with which the form was measured: that of the object, not of the
    /// remainder while it comes or goes.
    pub peak_breadth: u32,
}

#[cfg(test)]
impl Contact {
    /// A contact of 3 x 3 taxels about column 4 of row 4, for tests.
    pub(crate) fn of_nine(id: u32, panel: u8, total: u32) -> Contact {
        Contact {
            id,
            phase: Phase::Held,
            panel,
            total,
            peak: (total / 9) as u16,
            peak_at: Place { panel, row: 4, column: 4 },
            area: 9,
            perimeter: 8,
            edge: 0,
            bounds: Rect { panel, top: 3, bottom: 5, left: 3, right: 5 },
            x: Fixed16(4 << 16),
            y: Fixed16(4 << 16),
            azimuth: None,
            anisotropy: Q15(0),
            breadth: 300,
            peak_breadth: 300,
            dx: Fixed16(0),
            dy: Fixed16(0),
            vx: Fixed16(0),
            vy: Fixed16(0),
            slip: false,
            onset: Micros(0),
            duration_ms: 0,
            peak_total: total,
        }
    }
}
