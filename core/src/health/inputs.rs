//! Check of the converter inputs: does an input still show its taxels? Codes alone cannot prove it; a
//! self-test must confirm a suspicion.
//!
//! In every fourth frame one input is checked, by a quarter of a row of each of its blocks, each time of
//! another row. An open line shows what was converted before, or drifts: many taxels show less pressure than
//! at rest, which no touch causes. A line that is connected to the supply shows the same code everywhere. If
//! an input shows this at rest already, the fault is not found.

use super::codes::Codes;
use crate::acquire::Plan;
use crate::format::{Code, Extremes};
use crate::garment::{Circuit, Site};

/// Smallest number of taxels that is evidence.
const FEW: u32 = 8;
/// A garment with fewer blocks than this is checked in whole rows.
const BLOCKS: usize = 8;
/// Least deviation from the code at rest that counts, counts.
const FAR: u16 = 8;

/// Input that is checked next.
#[derive(Debug, Clone)]
pub(super) struct InputCheck {
    /// None before the first.
    input: Option<u8>,
    round: u8,
    /// Frame counter.
    turn: u8,
}

impl InputCheck {
    /// Starts at the first input.
    pub const fn new() -> InputCheck {
        InputCheck { input: None, round: 0, turn: 0 }
    }

    /// Checks an input in every fourth frame; true if it seems faulty. `travel` is the median travel of a
    /// code while it is watched.
    pub fn is_one_odd(&mut self, circuit: &Circuit, plan: &Plan, shown: &Codes<'_>, travel: u16) -> bool {
        self.turn = self.turn.wrapping_add(1);
        if self.turn & 3 == 2 {
            // The next input is chosen in another frame than the check, so that no frame costs more than the
            // others.
            self.go_on(circuit);
        }
        let Some(rest) = shown.rest.filter(|_| self.turn & 3 == 0) else { return false };
        // Ten steps travel 1.13 times the noise each: `far` is at least four times the noise.
        let far = (travel / 8 * 3).max(plan.depth.step().saturating_mul(2)).max(FAR);
        let (first, shift) = if circuit.sites().len() < BLOCKS { (0, 0) } else { (self.round >> 2 & 3, 2) };
        // 0.613 of a turn, near the golden ratio, whose multiples are spread evenly.
        let part = self.round.wrapping_mul(157);
        let sites = circuit.sites().iter();
        let lines = sites
            .filter(|site| Some(site.input) == self.input && plan.reads(site.panel, site.block))
            .map(|site| TaxelLine::of(site, part, first, shift));
        let mut tally = Tally { far, ..Tally::default() };
        for line in lines.clone() {
            tally.take(line, shown.now, rest);
        }
        let (less, more) =
            if circuit.falling() { (tally.above, tally.below) } else { (tally.below, tally.above) };
        tally.count >= FEW
            && (less * 8 >= tally.count || more == tally.count && are_alike(lines, shown.now, rest, far))
    }

    /// Advances to the next input; after the last one, to the first in another round.
    fn go_on(&mut self, circuit: &Circuit) {
        let inputs = || circuit.sites().iter().map(|site| site.input);
        let next = inputs().filter(|input| Some(*input) > self.input).min();
        if next.is_none() {
            self.round = self.round.wrapping_add(1);
        }
        self.input = next.or_else(|| inputs().min());
    }
}

/// Taxels at equal distances in a wired row.
struct TaxelLine {
    /// The next taxel.
    taxel: usize,
    /// Distance from one taxel to the next.
    step: usize,
    /// Number of taxels left.
    count: u32,
}

impl TaxelLine {
    /// Every `2^shift`th taxel of a block from `first` on, in the row at `part` / 256 of its height.
    fn of(site: &Site, part: u8, first: u8, shift: u32) -> TaxelLine {
        // Without a division, which an M0+ does not have.
        let row = ((u16::from(part) * u16::from(site.rows)) >> 8) as u8;
        let count = (u32::from(site.columns.saturating_sub(first)) + (1 << shift) - 1) >> shift;
        // A negative step wraps: all additions to a taxel's number are modulo 2^32.
        TaxelLine { taxel: site.taxel(row, first), step: (site.column_step << shift) as usize, count }
    }
}

impl Iterator for TaxelLine {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        self.count = self.count.checked_sub(1)?;
        let taxel = self.taxel;
        self.taxel = taxel.wrapping_add(self.step);
        Some(taxel)
    }
}

/// Counts the taxels of an input whose codes deviate from those at rest.
#[derive(Default)]
struct Tally {
    /// Least deviation that counts, counts.
    far: u16,
    count: u32,
    below: u32,
    above: u32,
}

impl Tally {
    // M0+: out of line
    #[inline(never)]
    fn take(&mut self, line: TaxelLine, codes: &[Code], rest: &[u16]) {
        let (far, mut below, mut above) = (u32::from(self.far), 0, 0);
        for taxel in line {
            let Some((code, rest)) = codes.get(taxel).zip(rest.get(taxel)) else { continue };
            let (code, rest) = (u32::from(code.0), u32::from(*rest));
            self.count += 1;
            below += u32::from(code + far < rest);
            above += u32::from(code > rest + far);
        }
        self.below += below;
        self.above += above;
    }
}

/// True if the codes of all these taxels are nearly equal, and were not at rest.
#[cold]
fn are_alike(lines: impl Iterator<Item = TaxelLine>, codes: &[Code], rest: &[u16], far: u16) -> bool {
    let (mut now, mut before) = (Extremes::NONE, Extremes::NONE);
    for (code, rest) in lines.flatten().filter_map(|it| codes.get(it).zip(rest.get(it))) {
        now.take(code.0);
        before.take(*rest);
    }
    now.width() < far && before.width() > far.saturating_mul(2)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::garment::{Garment, Layout, Pins};
    use std::vec::Vec;

    #[test]
    fn taxels_of_a_line_are_counted_one_by_one() {
        let garment = Garment::reference();
        let layout = Layout::build(&garment, 2048, 4095).unwrap();
        let circuit = Circuit::build(&garment, &layout, Pins::ANY).unwrap();
        let mut state = 1u32;
        let mut next = |n: u32| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            (state >> 8) % n
        };
        let codes: Vec<Code> = (0..layout.taxels()).map(|_| Code(next(100) as u16)).collect();
        let rest: Vec<u16> = (0..layout.taxels()).map(|_| next(100) as u16).collect();
        for (site, shift) in circuit.sites().iter().flat_map(|site| [(site, 0), (site, 2)]) {
            let back = Site {
                origin: site.taxel(0, site.columns - 1) as i32,
                column_step: -site.column_step,
                ..*site
            };
            for site in [*site, back] {
                let (part, first, far) = (next(256) as u8, next(1 << shift) as u8, 1 + next(20) as u16);
                let mut tally = Tally { far, ..Tally::default() };
                tally.take(TaxelLine::of(&site, part, first, shift), &codes, &rest);
                let row = (u32::from(part) * u32::from(site.rows) / 256) as u8;
                let columns = (first..site.columns).step_by(1 << shift);
                let pairs: Vec<_> = columns
                    .map(|column| site.taxel(row, column))
                    .map(|taxel| (i32::from(codes[taxel].0), i32::from(rest[taxel])))
                    .collect();
                let count = |is: &dyn Fn(i32) -> bool| {
                    pairs.iter().filter(|(code, rest)| is(code - rest)).count() as u32
                };
                let plain =
                    (count(&|_| true), count(&|it| it < -i32::from(far)), count(&|it| it > far.into()));
                assert_eq!((tally.count, tally.below, tally.above), plain);
            }
        }
    }
}
