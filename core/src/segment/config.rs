//! Settings of the stage.

use crate::garment::Area;
use serde::{Deserialize, Serialize};

/// Thresholds of contacts, and limits of tracking and slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ContactConfig {
    /// Threshold of a component's taxels, counts; at least 1.
    pub low: u16,
    /// Peak at which a component becomes a contact, counts; not below `low`. Half of `low` in it is noise,
    /// the rest is pressure on a taxel of 120 mm2, or on one whose pitch is unknown. On others the pressure
    /// is the same up to 240 mm2, and the noise too, but the peak at least 1.5 `low`. A contact goes on down
    /// to half of that pressure, with the same noise.
    pub high: u16,
    /// Smallest area of a contact, taxels.
    pub min_area: u16,
    /// Search radius around the expected centroid of a contact, cm; 1 to 1000. Half the longer side of its
    /// box and the expected step are added to it. Where the pitch is unknown, a taxel counts as 10 mm.
    pub gate: u16,
    /// Time constant of the velocity, ms; 0 takes the velocity from one frame to the next.
    pub smoothing_ms: u16,
    /// Speed from which a contact slips, 1/16 cm/s. [`NO_SLIP`] turns slip off.
    pub slip_speed: u16,
    /// Number of held contacts that have their form measured in a frame, in turn; 0: all. See
    /// [`Forms`](crate::contact::Forms).
    pub forms_in_frame: u8,
}

/// The [`slip_speed`](ContactConfig::slip_speed) of a scene without slip.
pub const NO_SLIP: u16 = u16::MAX;

impl ContactConfig {
    /// Returns the peak from which on a contact begins on a panel, at most twice the threshold. However small
    /// its taxels are, it is clear of noise, as `measured` counts are, and, while the baseline drifts, of what
    /// is left of the drift.
    pub(crate) fn least_peak(&self, area: &Area, drifting: bool, measured: u16) -> u32 {
        let (high, noise) = (u32::from(self.high), self.noise());
        let clear = if drifting { high } else { high.min(u32::from(self.low) + noise) };
        (area.counts_of(high - noise) + noise).max(clear).max(u32::from(measured).min(2 * high))
    }

    /// Returns true if a contact goes on with this peak, where the least peak to begin is that: half of its
    /// pressure. A pressure, too: otherwise a touch would end earlier on smaller taxels.
    #[inline(always)]
    pub(crate) fn goes_on(&self, peak: u32, least_peak: u32) -> bool {
        2 * peak >= least_peak + self.noise()
    }

    /// Part of a peak that is noise, whatever the area of a taxel, counts.
    fn noise(&self) -> u32 {
        u32::from(self.low) / 2
    }

    /// True if the scene looks for slip.
    #[inline(always)]
    pub(crate) const fn slips(&self) -> bool {
        self.slip_speed != NO_SLIP
    }
}

impl Default for ContactConfig {
    /// The velocity of a still finger of 2 x 2 taxels at 1000 counts with a noise of 3 counts stays below 0.3
    /// taxel/s, so 4 cm/s are clear of noise at 10 mm pitch, and below the stroke of a hand (about 10 cm/s).
    fn default() -> Self {
        ContactConfig {
            low: 60,
            high: 120,
            min_area: 1,
            gate: 4,
            smoothing_ms: 40,
            slip_speed: 64,
            forms_in_frame: 1,
        }
    }
}
