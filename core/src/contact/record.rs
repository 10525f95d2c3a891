//! What is told of a contact.

use crate::format::{Fixed16, Micros, Q15, Turn};
use crate::garment::{Place, Rect};
use serde::{Deserialize, Serialize};

/// Where a contact is in its life.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// Its first frame.
    #[default]
    Onset,
    /// It was there in the previous frame.
    Held,
    /// It is gone: the values are the last ones, the total is 0. Told once.
    Released,
}

/// One contact in one frame. Coordinates are taxels of its home panel, the one with most of its mass; a part
/// beyond a seam continues them past the border.
///
/// Pressure, area, place and motion are those of the frame. The form (`perimeter`, `edge`, `azimuth`,
/// `anisotropy`, `breadth`) is that of the last frame in which it was looked at: its first one, and from then
/// on each of those present has its turn, [`Forms`](super::Forms) in a frame. Of a lone contact it is always
/// of the frame, of five contacts at most four frames old if one has its turn.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Contact {
    /// From 1 upwards in the order of onsets; the same from onset to release.
    pub id: u32,
    /// Where it is in its life.
    pub phase: Phase,
    /// Index of its home panel.
    pub panel: u8,
    /// Sum of the pressure, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// The first taxel with that pressure; of another panel where the contact crosses a seam.
    pub peak_at: Place,
    /// Taxels.
    pub area: u16,
    /// Taxels with at least one of four neighbours in the panel, or beyond its border, below the low threshold.
    pub perimeter: u16,
    /// Mean slope over those taxels, counts per taxel (Sobel magnitude / 8); saturates.
    pub edge: u16,
    /// The smallest rectangle of the home panel around what lies there.
    pub bounds: Rect,
    /// Centroid (eq. 1 and 2, from 0), rounded once: half a step off at most.
    pub x: Fixed16,
    /// As `x`, across the rows.
    pub y: Fixed16,
    /// Direction of the major axis, see [`Axis`](super::Axis); none where the contact has no direction.
    pub azimuth: Option<Turn>,
    /// 0 for a disc or square, 1 for a line.
    pub anisotropy: Q15,
    /// Width across the major axis in 0.1 mm, see [`breadth`](super::breadth); at 10 mm pitch where the panel
    /// gives none.
    pub breadth: u32,
    /// Way since onset along x, of the centroid or of the pattern inside; follows the contact across seams.
    /// The leaps of merging and parting do not count.
    pub dx: Fixed16,
    /// Way since onset along y.
    pub dy: Fixed16,
    /// Smoothed velocity along x, taxels per second.
    pub vx: Fixed16,
    /// Smoothed velocity along y.
    pub vy: Fixed16,
    /// It slips: see the [module](super).
    pub slip: bool,
    /// Time of its first frame.
    pub onset: Micros,
    /// Time since onset, ms.
    pub duration_ms: u32,
    /// Greatest total since onset.
    pub peak_total: u32,
    /// Breadth when it was looked at with the greatest total: what touches, not what is left of it while it
    /// comes or goes.
    pub peak_breadth: u32,
}
