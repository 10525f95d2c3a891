//! What is to be thought of a taxel after it was watched.

use super::seen::Seen;
use super::taxel::TaxelHealth;
use crate::format::Code;
use crate::garment::Area;

/// So near to an end of the converter's range a code is at that end, counts: five times a noise of 3.
const RAIL: u16 = 16;
/// A taxel that shows so much at rest has a signal; one that shows none later has lost it.
const SIGNAL: u16 = 3 * RAIL;
/// Taxels are pressed from here on, counts above rest.
const PRESSED: i32 = 128;
/// Where the codes of many taxels range over less than so many steps, one that does not move tells nothing.
const LIVELY: u16 = 8;
/// A code that ranges over so much more than four times what is usual is not merely noisier than most.
const LOUD: u16 = 24;

/// What the taxels of a garment show now.
pub(super) struct Shown<'a> {
    pub codes: &'a [Code],
    /// Codes at rest; none: not known.
    pub rest: Option<&'a [u16]>,
    pub full: u16,
    pub falling: bool,
    /// Mean range of the codes of the taxels that are watched together.
    pub usual: u16,
    /// Step of the codes.
    pub step: u16,
    /// Something touches the garment: only then can a taxel be missed among its neighbours.
    pub touched: bool,
}

impl Shown<'_> {
    fn pressure(&self, code: u16) -> i32 {
        i32::from(if self.falling { self.full.saturating_sub(code) } else { code })
    }

    /// Pressure of a taxel at rest.
    fn at_rest(&self, taxel: usize) -> Option<i32> {
        Some(self.pressure(*self.rest?.get(taxel)?))
    }

    fn is_pressed(&self, taxel: usize) -> bool {
        let now = self.codes.get(taxel).map(|code| self.pressure(code.0));
        let more = now.zip(self.at_rest(taxel)).map(|(now, rest)| now - rest);
        more.is_some_and(|more| more >= PRESSED)
    }

    /// How many of the neighbours of a taxel there are, and how many of them are pressed; counts no further than to the second
    /// that is not.
    fn surroundings(&self, area: &Area, row: u16, column: u16) -> (u32, u32) {
        let (mut there, mut pressed) = (0, 0);
        for y in row.saturating_sub(1)..=row.saturating_add(1).min(area.rows.saturating_sub(1)) {
            for x in column.saturating_sub(1)..=column.saturating_add(1).min(area.columns.saturating_sub(1)) {
                if (y, x) == (row, column) {
                    continue;
                }
                there += 1;
                let taxel =
                    usize::from(area.base) + usize::from(y) * usize::from(area.columns) + usize::from(x);
                pressed += u32::from(self.is_pressed(taxel));
                if there > pressed + 1 {
                    return (there, pressed);
                }
            }
        }
        (there, pressed)
    }

    /// Whether anything beside a taxel is pressed.
    fn is_near_pressure(&self, area: &Area, row: u16, column: u16) -> bool {
        (row.saturating_sub(1)..=row.saturating_add(1).min(area.rows.saturating_sub(1))).any(|y| {
            (column.saturating_sub(1)..=column.saturating_add(1).min(area.columns.saturating_sub(1))).any(
                |x| {
                    let taxel =
                        usize::from(area.base) + usize::from(y) * usize::from(area.columns) + usize::from(x);
                    (y, x) != (row, column) && self.is_pressed(taxel)
                },
            )
        })
    }

    /// Judges a taxel by what was seen of it.
    pub fn judge(&self, seen: &Seen, area: &Area, row: u16, column: u16, taxel: usize) -> TaxelHealth {
        let (low, high) = seen.pressure(self.falling.then_some(self.full));
        let still = seen.range() == 0 && self.usual >= LIVELY.saturating_mul(self.step);
        if low >= self.full.saturating_sub(RAIL) {
            // What presses one taxel to full scale presses those beside it, too.
            let alone = self.rest.is_some() && !self.is_near_pressure(area, row, column);
            return if alone { TaxelHealth::Shorted } else { TaxelHealth::Good };
        }
        if still && high > 0 {
            return TaxelHealth::Stuck;
        }
        let loud = self.usual.saturating_mul(4).saturating_add(LOUD);
        // There and back is what a touch does; the usual noise of some frames comes on top.
        let touch = seen.range().saturating_mul(2).saturating_add(self.usual.saturating_mul(4));
        if seen.range() > loud && seen.travel() > touch {
            return TaxelHealth::Noisy;
        }
        let Some(rest) = self.at_rest(taxel) else { return TaxelHealth::Good };
        if high <= RAIL && rest >= i32::from(SIGNAL) {
            return TaxelHealth::Open;
        }
        // The frame in which it is judged counts, too: a touch may have begun since.
        let now = self.codes.get(taxel).map_or(0, |code| self.pressure(code.0));
        if !self.touched || i32::from(high).max(now) - rest > i32::from(RAIL.max(self.step + 1)) {
            return TaxelHealth::Good;
        }
        match self.surroundings(area, row, column) {
            (there, pressed) if there < 3 || pressed < 3 || there > pressed + 1 => TaxelHealth::Good,
            _ if high <= RAIL => TaxelHealth::Open,
            _ => TaxelHealth::Dead,
        }
    }
}
