//! How the panels drift as a whole.

use super::slices::panel_of;
use crate::garment::{Area, PANELS};

/// Taxels of a panel that are asked.
const WITNESSES: usize = 16;

/// The median drift of each panel, from the baselines of some witnesses spread over it.
///
/// The witnesses of a panel vote once in a rotation: if more than half of them have drifted further than the panel is known
/// to have, it moves by one count, and with it the baseline of every taxel that may not follow its own code. Those that are
/// witnesses then agree with what is known, so that a panel of which half is touched stands still.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Consensus([Panel; PANELS]);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Panel {
    /// Baselines of the witnesses when all began.
    first: [u16; WITNESSES],
    begun: bool,
    /// Drift since then.
    drift: i32,
    /// The last step of it.
    step: i8,
}

impl Consensus {
    pub const fn new() -> Self {
        Consensus([Panel { first: [0; WITNESSES], begun: false, drift: 0, step: 0 }; PANELS])
    }

    /// Begins anew, since baselines have been set.
    pub fn forget(&mut self) {
        self.0.iter_mut().for_each(|panel| (panel.begun, panel.step) = (false, 0));
    }

    /// What the taxels of a panel that stand still are to move by.
    pub fn step(&self, panel: u8) -> i32 {
        self.0.get(usize::from(panel)).map_or(0, |panel| panel.step.into())
    }

    /// Asks the witnesses of a panel, given the baselines and gains of all taxels.
    pub fn vote(&mut self, panel: u8, area: &Area, baseline: &[u16], gain: &[u16]) {
        let Some(panel) = self.0.get_mut(usize::from(panel)) else { return };
        let (baseline, gain) = (panel_of(baseline, area), panel_of(gain, area));
        if !panel.begun {
            (panel.begun, panel.drift) = (true, 0);
            witnesses(baseline.len()).zip(&mut panel.first).for_each(|(at, first)| {
                *first = baseline.get(at).copied().unwrap_or(0);
            });
        }
        let (mut asked, mut up, mut down) = (0, 0, 0);
        for (at, first) in witnesses(baseline.len()).zip(&panel.first) {
            // Absent and dead ones are not asked.
            if gain.get(at).is_some_and(|gain| *gain != 0)
                && let Some(now) = baseline.get(at)
            {
                let drift = i32::from(*now) - i32::from(*first);
                asked += 1;
                up += i32::from(drift > panel.drift);
                down += i32::from(drift < panel.drift);
            }
        }
        panel.step = i8::from(2 * up > asked) - i8::from(2 * down > asked);
        panel.drift += i32::from(panel.step);
    }
}

/// Where they are in a panel of so many taxels: an odd distance apart, lest they stand in one column.
fn witnesses(taxels: usize) -> impl Iterator<Item = usize> {
    let stride = (taxels / WITNESSES) | 1;
    (0..WITNESSES).scan(0, move |next, _| {
        let at = *next;
        *next += stride;
        if *next >= taxels {
            *next -= taxels;
        }
        Some(at)
    })
}
