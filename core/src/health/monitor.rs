//! Watches the taxels, some at a time.

use super::judge::Shown;
use super::seen::Seen;
use super::taxel::TaxelHealth;
use crate::acquire::Plan;
use crate::format::Code;
use crate::garment::{Area, Circuit, Layout};
use core::ops::Range;
use heapless::Vec;

/// Frames from one judgement to the next.
pub const FRAMES: u8 = 12;
/// Frames of them in which taxels are judged, so that none takes much longer than the others.
const JUDGING: u8 = 2;
/// Taxels that are watched at a time.
const WATCHED: usize = 256;
/// Taxels that are judged in a frame.
const JUDGED: usize = WATCHED / JUDGING as usize;
/// Range at which a touch counts for no more in the mean.
const TOUCHED: u16 = 64;

/// Most ill taxels that are remembered.
pub const ILL: usize = 128;
/// Most taxels that fall ill in a frame. Where more seem to, it is not the taxels that are: none is called so.
const FOUND: usize = JUDGED / 8;

/// A taxel that is ill.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IllTaxel {
    /// Its number.
    pub taxel: u16,
    /// What is wrong with it.
    pub health: TaxelHealth,
    /// Its gain when it is well, Q4.12.
    pub gain: u16,
}

/// What a garment shows.
#[derive(Debug, Clone, Copy)]
pub struct Codes<'a> {
    /// The codes of a frame.
    pub now: &'a [Code],
    /// Codes at rest; none: not known.
    pub rest: Option<&'a [u16]>,
    /// The largest code there is.
    pub full: u16,
    /// Something touches the garment.
    pub touched: bool,
}

/// Taxels that were found to be ill in a frame.
pub type Found = Vec<(u16, TaxelHealth), FOUND>;

/// The health of a garment.
#[derive(Debug, Clone)]
pub struct Monitor {
    /// By number.
    ill: Vec<IllTaxel, ILL>,
    seen: [Seen; WATCHED],
    /// First of the taxels that are watched.
    first: u16,
    /// Frame of the watch.
    frame: u8,
    /// Mean range of the last watch.
    usual: u16,
    /// Step of the codes of the last watch.
    step: u16,
}

impl Monitor {
    /// Nothing is known against any taxel.
    pub const fn new() -> Self {
        Monitor { ill: Vec::new(), seen: [Seen::NOTHING; WATCHED], first: 0, frame: 0, usual: 0, step: 1 }
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        self.ill.clear();
        self.again();
    }

    /// Watches anew; what was found stays.
    pub fn again(&mut self) {
        (self.first, self.frame) = (0, 0);
    }

    /// The ill taxels by number.
    pub fn ill(&self) -> &[IllTaxel] {
        &self.ill
    }

    /// What is known of a taxel, if it is ill.
    pub fn ill_mut(&mut self, taxel: usize) -> Option<&mut IllTaxel> {
        self.ill.iter_mut().find(|ill| usize::from(ill.taxel) == taxel)
    }

    /// The class of a taxel.
    pub fn health(&self, taxel: usize) -> TaxelHealth {
        let ill = self.ill.iter().find(|ill| usize::from(ill.taxel) == taxel);
        ill.map_or(TaxelHealth::Good, |ill| ill.health)
    }

    /// Takes down that a taxel is ill. `false`: too many are.
    pub fn add(&mut self, ill: IllTaxel) -> bool {
        if self.ill.push(ill).is_err() {
            return false;
        }
        // Down to its place; the library's own insertion panics where there is none.
        for at in (1..self.ill.len()).rev() {
            if let Some([a, b, ..]) = self.ill.get_mut(at - 1..)
                && b.taxel < a.taxel
            {
                core::mem::swap(a, b);
            }
        }
        true
    }

    /// Takes a frame; what seems to be ill is for the caller to [`Monitor::add`].
    pub fn watch(&mut self, layout: &Layout, circuit: &Circuit, plan: &Plan, shown: Codes<'_>) -> Found {
        let Codes { now: codes, rest, full, touched } = shown;
        let mut found = Found::new();
        let watched = codes.get(usize::from(self.first)..).unwrap_or(&[]);
        match self.frame.checked_sub(FRAMES - JUDGING) {
            None if self.frame == 0 => {
                self.seen.iter_mut().zip(watched).for_each(|(seen, code)| seen.begin(*code));
            }
            None => self.seen.iter_mut().zip(watched).for_each(|(seen, code)| seen.see(*code)),
            Some(part) => {
                if part == 0 {
                    let watched = layout.taxels().saturating_sub(usize::from(self.first)).min(WATCHED);
                    let watched = self.seen.get(..watched).unwrap_or(&[]);
                    // Codes of 8 bits repeat their upper bits below: they do not show their step.
                    self.step = step(watched).max(plan.depth.step());
                    self.usual = usual_range(watched);
                }
                let (falling, usual, step) = (circuit.falling(), self.usual, self.step);
                let shown = Shown { codes, rest, full, falling, usual, step, touched };
                let first = usize::from(self.first) + usize::from(part) * JUDGED;
                let taxels = first..(first + JUDGED).min(layout.taxels());
                if self.suspect(layout, circuit, plan, &shown, taxels, &mut found).is_none() {
                    found.clear();
                }
            }
        }
        self.frame += 1;
        if self.frame >= FRAMES {
            self.frame = 0;
            let next = usize::from(self.first) + WATCHED;
            self.first = if next < layout.taxels() { next as u16 } else { 0 };
        }
        found
    }

    /// Whether the taxels beside, above and below one that were watched with it range over less than half as much as it does:
    /// what touches or shakes it would move them, too.
    fn is_alone(&self, taxel: usize, area: &Area, column: u16) -> bool {
        let seen = |taxel: Option<usize>| self.seen.get(taxel?.checked_sub(usize::from(self.first))?);
        let own = seen(Some(taxel)).map_or(0, Seen::range);
        let columns = usize::from(area.columns);
        let left = (column > 0).then(|| taxel.wrapping_sub(1));
        let right = (column + 1 < area.columns).then_some(taxel + 1);
        [left, right, taxel.checked_sub(columns), Some(taxel + columns)]
            .into_iter()
            .filter_map(seen)
            .all(|beside| beside.range() < own / 2)
    }

    /// Finds what is to be said against some taxels; none where that is too much.
    fn suspect(
        &self,
        layout: &Layout,
        circuit: &Circuit,
        plan: &Plan,
        shown: &Shown<'_>,
        taxels: Range<usize>,
        found: &mut Found,
    ) -> Option<()> {
        for (panel, area) in (0u8..).zip(layout.areas()) {
            for row in 0..area.rows {
                let start = usize::from(area.base) + usize::from(row) * usize::from(area.columns);
                if start >= taxels.end || start + usize::from(area.columns) <= taxels.start {
                    continue;
                }
                for (column, taxel) in (0..area.columns).zip(start..).filter(|(_, t)| taxels.contains(t)) {
                    let Some(seen) = self.seen.get(taxel - usize::from(self.first)) else { continue };
                    let mut health = shown.judge(seen, area, row, column, taxel);
                    if health == TaxelHealth::Noisy && !self.is_alone(taxel, area, column) {
                        health = TaxelHealth::Good;
                    }
                    // Whatever is not there, or not read, shows nothing.
                    if health != TaxelHealth::Good
                        && self.health(taxel) == TaxelHealth::Good
                        && !layout.is_absent(panel, row, column)
                        && circuit.wired(taxel).is_some_and(|(block, ..)| plan.reads(panel, block))
                    {
                        found.push((taxel as u16, health)).ok()?;
                    }
                }
            }
        }
        Some(())
    }
}

impl Default for Monitor {
    fn default() -> Self {
        Monitor::new()
    }
}

/// Mean range of some taxels; a touch does not count for much.
fn usual_range(watched: &[Seen]) -> u16 {
    let sum: u32 = watched.iter().map(|seen| u32::from(seen.range().min(TOUCHED))).sum();
    sum.checked_div(watched.len() as u32).unwrap_or(0) as u16
}

/// The power of two that all their codes are multiples of: 16 where a converter gives 8 bits of 12.
fn step(watched: &[Seen]) -> u16 {
    let bits = watched.iter().fold(0, |bits, seen| bits | seen.bits());
    (bits & bits.wrapping_neg()).max(1)
}
