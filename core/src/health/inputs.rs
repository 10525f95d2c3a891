//! Whether a converter input still shows its taxels. It cannot be told for sure from codes alone: what speaks against an input is
//! for a self-test to confirm.
//!
//! In every fourth frame one input is looked at, by a quarter of a row of each of its blocks, every time of another row. A line that
//! lies open shows what was converted before, or drifts: many taxels show less pressure than at rest, as no touch makes them. One
//! that is connected to the supply shows the same everywhere. What an input at rest shows anyway is not told apart from that.

use super::monitor::Codes;
use crate::acquire::Plan;
use crate::format::Extremes;
use crate::garment::Circuit;

/// Fewer taxels tell nothing.
const FEW: u16 = 8;
/// A garment with fewer blocks is looked at in whole rows.
const BLOCKS: usize = 8;
/// A code is so far from that at rest at least where that means something, counts.
const FAR: u16 = 8;

/// Which input is looked at next.
#[derive(Debug, Clone)]
pub(super) struct Inputs {
    input: u8,
    round: u8,
    /// Counts frames.
    turn: u8,
}

impl Inputs {
    /// The first one.
    pub const fn new() -> Inputs {
        Inputs { input: u8::MAX, round: 0, turn: 0 }
    }

    /// Looks at an input in every fourth frame. `travel`: how far half of the codes travel while they are watched.
    pub fn is_one_odd(&mut self, circuit: &Circuit, plan: &Plan, shown: &Codes<'_>, travel: u16) -> bool {
        self.turn = self.turn.wrapping_add(1);
        let Some(rest) = shown.rest.filter(|_| self.turn & 3 == 0) else { return false };
        self.go_on(circuit);
        // Ten steps of 1.13 times their noise: four times the noise, and more.
        let far = (travel / 8 * 3).max(plan.depth.step().saturating_mul(2)).max(FAR);
        let mut tally = Tally::new(circuit.falling(), far);
        let (first, step) = if circuit.sites().len() < BLOCKS { (0, 1) } else { (self.round >> 2 & 3, 4) };
        // 0.613 of a turn: near the golden ratio, whose multiples are spread evenly.
        let part = self.round.wrapping_mul(157);
        let sites = circuit.sites().iter();
        for site in sites.filter(|site| site.input == self.input && plan.reads(site.panel, site.block)) {
            // Without a division: this core has none.
            let row = ((u16::from(part) * u16::from(site.rows)) >> 8) as u8;
            let mut column = first;
            while column < site.columns {
                let taxel = site.taxel(row, column);
                if let Some((code, rest)) = shown.now.get(taxel).zip(rest.get(taxel)) {
                    tally.take(code.0, *rest);
                }
                column = column.saturating_add(step);
            }
        }
        tally.is_odd()
    }

    /// The next input in order; after the last one the first, in another round.
    fn go_on(&mut self, circuit: &Circuit) {
        let inputs = || circuit.sites().iter().map(|site| site.input);
        let next = inputs().filter(|input| *input > self.input).min();
        if next.is_none() {
            self.round = self.round.wrapping_add(1);
        }
        self.input = next.or_else(|| inputs().min()).unwrap_or(u8::MAX);
    }
}

/// What the taxels of an input show, and showed at rest.
struct Tally {
    falling: bool,
    far: u16,
    count: u16,
    /// Those that show less pressure than at rest, and those that show more.
    less: u16,
    more: u16,
    codes: Extremes,
    rests: Extremes,
}

impl Tally {
    fn new(falling: bool, far: u16) -> Tally {
        Tally { falling, far, count: 0, less: 0, more: 0, codes: Extremes::NONE, rests: Extremes::NONE }
    }

    fn take(&mut self, code: u16, rest: u16) {
        let (now, before) = if self.falling { (rest, code) } else { (code, rest) };
        self.count += 1;
        self.less += u16::from(now.saturating_add(self.far) < before);
        self.more += u16::from(now > before.saturating_add(self.far));
        self.codes.take(code);
        self.rests.take(rest);
    }

    fn is_odd(&self) -> bool {
        let alike = self.codes.width() < self.far && self.rests.width() > self.far.saturating_mul(2);
        self.count >= FEW && (self.less * 8 >= self.count || alike && self.more == self.count)
    }
}
