//! Settings of the stage.

use serde::{Deserialize, Serialize};

/// What is a contact, and how it is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContactConfig {
    /// Taxels from this many counts on belong to a component; at least 1.
    pub low: u16,
    /// A component begins to be a contact when its peak reaches this many counts; not below `low`. It stays
    /// one while its peak is at least `low`.
    pub high: u16,
    /// Smallest number of taxels.
    pub min_area: u16,
    /// A contact is looked for within so many cm of where it should be (and half the size of its box, and the
    /// way that it made since); 1 to 1000. A cm is a taxel where taxels lie 10 mm apart, and where nothing is
    /// known of that.
    pub gate: u16,
    /// Time constant of the velocity, in ms; 0 takes it from one frame to the next.
    pub smoothing_ms: u16,
    /// Speed from which a contact slips, in 1/16 cm/s. With [`NO_SLIP`] none does, and the pattern inside
    /// contacts is not followed, which saves its cycles.
    pub slip_speed: u16,
}

/// The [`slip_speed`](ContactConfig::slip_speed) of a scene that does not ask for slip.
pub const NO_SLIP: u16 = u16::MAX;

impl Default for ContactConfig {
    /// The velocity of a still finger of 2 x 2 taxels at 1000 counts with a noise of 3 counts stays below 0.3
    /// taxel/s, so 4 cm/s are clear of noise at 10 mm pitch, and below the stroke of a hand (about 10 cm/s).
    fn default() -> Self {
        ContactConfig { low: 60, high: 120, min_area: 1, gate: 4, smoothing_ms: 40, slip_speed: 64 }
    }
}
