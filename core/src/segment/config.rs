//! Settings of the stage.

use serde::{Deserialize, Serialize};

/// Thresholds of contacts, and limits of tracking and slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContactConfig {
    /// Threshold of a component's taxels, counts; at least 1.
    pub low: u16,
    /// Peak at which a component becomes a contact, counts; not below `low`. It stays one while its peak is
    /// at least `low`. The value is that of a taxel of 120 mm2, or of one whose pitch is unknown; on others
    /// the peak is that of the same pressure, but at least 1.5 `low`, and at most twice the value.
    pub high: u16,
    /// Smallest area of a contact, taxels.
    pub min_area: u16,
    /// Search radius around the expected centroid of a contact, cm; 1 to 1000. Half the longer side of its
    /// box and the expected step are added to it. Where the pitch is unknown, a taxel counts as 10 mm.
    pub gate: u16,
    /// Time constant of the velocity, ms; 0 takes the velocity from one frame to the next.
    pub smoothing_ms: u16,
    /// Speed from which a contact slips, 1/16 cm/s. [`NO_SLIP`] turns slip off and saves the cycles of
    /// following the pattern inside contacts.
    pub slip_speed: u16,
}

/// The [`slip_speed`](ContactConfig::slip_speed) of a scene without slip; the only one of a build without the
/// feature `slip`.
pub const NO_SLIP: u16 = u16::MAX;

/// The default: 4 cm/s.
const SLIP: u16 = if cfg!(feature = "slip") { 64 } else { NO_SLIP };

impl ContactConfig {
    /// Returns the peak from which on a contact may begin on any panel, however small its taxels are. While
    /// the baseline drifts fast, what is left of the drift is no contact.
    pub(crate) fn clear_peak(&self, drifting: bool) -> u32 {
        let high = u32::from(self.high);
        if drifting { high } else { high.min(u32::from(self.low) * 3 / 2) }
    }

    /// True if the scene looks for slip.
    #[inline(always)]
    pub(crate) const fn slips(&self) -> bool {
        cfg!(feature = "slip") && self.slip_speed != NO_SLIP
    }
}

impl Default for ContactConfig {
    /// The velocity of a still finger of 2 x 2 taxels at 1000 counts with a noise of 3 counts stays below 0.3
    /// taxel/s, so 4 cm/s are clear of noise at 10 mm pitch, and below the stroke of a hand (about 10 cm/s).
    fn default() -> Self {
        ContactConfig { low: 60, high: 120, min_area: 1, gate: 4, smoothing_ms: 40, slip_speed: SLIP }
    }
}
