//! How the panels drift as a whole.

use super::panel::{Orders, Panel};
use super::terms::Terms;
use super::witness::{Said, Seen, WITNESSES, place};
use crate::format::Micros;
use crate::garment::PANELS;
use core::ops::Range;

/// The drift of all panels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Common {
    panels: [Panel; PANELS],
    /// What the panel whose rows have their turn has said up to now.
    said: Said,
}

impl Common {
    pub const fn new() -> Self {
        Common { panels: [Panel::NONE; PANELS], said: Said::NONE }
    }

    /// Begins anew, since baselines have been set; what is known of the taxels stays.
    pub fn forget(&mut self) {
        self.panels.iter_mut().for_each(Panel::forget);
    }

    /// The first row of a panel has its turn.
    pub fn begin(&mut self, panel: u8, floor: u16) {
        self.said = Said::NONE;
        if let Some(panel) = self.panels.get_mut(usize::from(panel)) {
            panel.begin(floor);
        }
    }

    /// Asks the witnesses among `range`, which are the taxels of a row by their number in a panel of so many; `seen` tells
    /// of one what it shows, if it says anything: absent and dead ones do not.
    #[inline(always)]
    pub fn ask(
        &mut self,
        panel: u8,
        (range, taxels): (Range<usize>, usize),
        terms: Terms,
        seen: impl Fn(usize, &Orders) -> Option<Seen>,
    ) {
        let Some(panel) = self.panels.get_mut(usize::from(panel)) else { return };
        while usize::from(self.said.next) < WITNESSES {
            let witness = usize::from(self.said.next);
            let at = place(witness, taxels);
            if at >= range.end {
                return;
            }
            self.said.next += 1;
            if at >= range.start
                && let Some(seen) = seen(at, &panel.orders)
            {
                panel.hear(witness, &seen, (terms.floor, terms.falling), &mut self.said);
            }
        }
    }

    /// All rows of a panel have had their turn: what they are to do in the next.
    #[inline(never)] // M0+: out of line
    pub fn decide(&mut self, panel: u8, now: Micros, touched: bool, floor: u16) {
        if let Some(panel) = self.panels.get_mut(usize::from(panel)) {
            panel.decide(&self.said, now, touched, floor);
        }
    }

    /// What the rows of a panel are to do; nothing in its first turn.
    pub fn orders(&self, panel: u8) -> Option<&Orders> {
        let panel = self.panels.get(usize::from(panel)).filter(|panel| panel.runs())?;
        Some(&panel.orders)
    }

    /// A touch on a panel leaves the strongest code of a row so far off, counts.
    pub fn felt(&mut self, panel: u8, strongest: u16) {
        if let Some(panel) = self.panels.get_mut(usize::from(panel)) {
            panel.felt(strongest);
        }
    }

    /// A bit for each panel whose baseline is unsure.
    pub fn unsure(&self) -> u8 {
        let bits = self.panels.iter().enumerate().map(|(panel, it)| u8::from(it.unsure) << panel);
        bits.fold(0, |all, bit| all | bit)
    }
}
