//! Judges a taxel by the codes that were seen of it.

use super::seen::Seen;
use super::taxel::TaxelHealth;
use super::walk::TaxelSpot;
use crate::format::Code;

/// Distance from an end of the converter's range that counts as that end, counts: five times a noise of 3.
const RAIL: u16 = 16;
/// Least pressure at rest that counts as a signal: a taxel that shows none later has lost it.
const SIGNAL: u16 = 3 * RAIL;
/// Least pressure above rest of a pressed taxel, counts.
const PRESSED: i32 = 128;
/// Median travel, in steps, below which a code that does not move is no evidence: noise of 1.8 steps rms.
const LIVELY: u16 = 20;
/// Travel beyond three times the median that noise does not explain, counts.
const NOISY: u16 = 52;
/// Travel of a code that goes to the next step and back in every frame, in steps.
const STEPS: u16 = 12;

/// True if a code shows pressure beyond that at rest.
pub(super) const fn is_pressed(code: u16, rest: u16, falling: bool) -> bool {
    let (more, less) = if falling { (rest, code) } else { (code, rest) };
    more as i32 - less as i32 >= PRESSED
}

/// Limits of this frame, from the travel of all taxels.
pub(super) struct Limits {
    /// Typical noise is high enough that a constant code is evidence.
    lively: bool,
    /// Greatest travel that counts as usual noise.
    noisy: u16,
    /// Travel of the usual noise while something touches.
    usual: u32,
    /// Distance from the code at rest that a pressed taxel exceeds.
    idle: i32,
}

impl Limits {
    /// Limits for a median travel of `usual` and codes in steps of `step` counts.
    pub fn of(usual: u16, step: u16) -> Limits {
        Limits {
            lively: usual >= LIVELY.saturating_mul(step),
            noisy: usual.saturating_mul(3).saturating_add(NOISY).saturating_add(step.saturating_mul(STEPS)),
            usual: u32::from(usual) * 2,
            idle: i32::from(RAIL).max(i32::from(step) + 1),
        }
    }
}

/// Codes of a garment now, and those at rest.
pub(super) struct Shown<'a> {
    pub codes: &'a [Code],
    /// Codes at rest; none if unknown.
    pub rest: Option<&'a [u16]>,
    pub full: u16,
    pub falling: bool,
    pub limits: Limits,
    /// True if something touches the garment: only then can a dead taxel be found among its neighbours.
    pub touched: bool,
}

/// True for codes that may hide noise: four codes of the RP2040's converter are nine codes wide (erratum
/// E11).
const fn is_wide(code: u16) -> bool {
    code % 1024 == 512
}

/// Packs the first 32 answers, the first one in the lowest bit.
fn bits(answers: impl Iterator<Item = bool>) -> u32 {
    let (mut bits, mut bit) = (0, 1);
    for answer in answers {
        if answer {
            bits |= bit;
        }
        bit <<= 1;
    }
    bits
}

/// Taxels of a group that are to be judged, the first one in the lowest bit. Most are not; bits past the last
/// taxel have no meaning.
pub(super) struct Suspects {
    /// Their noise differs from that of most, or they have come to an end of the range.
    pub odd: u32,
    /// They lie beside a pressed taxel and are not pressed themselves: only a touch that covers them can be
    /// evidence against them.
    pub beside: u32,
}

/// Returns the first `count` taxels that are far from their code at rest, the first one in the lowest bit.
// M0+: out of line
#[inline(never)]
fn pressed(codes: &[Code], rest: &[u16], count: usize) -> u32 {
    let pairs = codes.iter().zip(rest).take(count);
    bits(pairs.map(|(code, rest)| code.0.abs_diff(*rest) >= PRESSED as u16))
}

/// Returns the number of taxels that are not pressed.
// M0+: out of line
#[inline(never)]
fn idle(codes: &[Code], rest: &[u16], falling: bool) -> usize {
    codes.iter().zip(rest).filter(|(code, rest)| !is_pressed(code.0, **rest, falling)).count()
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
        let rest = self.rest.and_then(|rest| rest.get(taxel));
        self.codes.get(taxel).zip(rest).is_some_and(|(code, rest)| is_pressed(code.0, *rest, self.falling))
    }

    /// Counts the healthy taxels at a distance from a taxel, in rows or columns, whichever is larger, and how
    /// many of them are pressed. Stops once more than `missing` are not.
    fn around(
        &self,
        spot: &TaxelSpot<'_>,
        distance: u16,
        missing: u32,
        is_faulty: impl Fn(usize) -> bool,
    ) -> (u32, u32) {
        let (mut there, mut pressed) = (0, 0);
        let TaxelSpot { area, row, column, .. } = *spot;
        let (rows, columns) = (i32::from(area.rows), i32::from(area.columns));
        let (row, column, distance) = (i32::from(row), i32::from(column), i32::from(distance));
        for y in (row - distance).max(0)..=(row + distance).min(rows - 1) {
            // All columns of the first and the last row, only the ends of those between.
            let step = if (y - row).abs() == distance { 1 } else { 2 * distance };
            let begin = i32::from(area.base) + y * columns;
            let mut x = column - distance;
            while x <= column + distance {
                let taxel = (begin + x) as usize;
                let is_there = x >= 0 && x < columns && !is_faulty(taxel);
                x += step;
                if !is_there {
                    continue;
                }
                there += 1;
                pressed += u32::from(self.is_pressed(taxel));
                if there > pressed + missing {
                    return (there, pressed);
                }
            }
        }
        (there, pressed)
    }

    /// True if what presses around a taxel should press it too: all neighbours but one, and four fifths of
    /// those around them. A ring with a hole of one taxel and a wall of one or two does not reach that far.
    fn is_covered(&self, spot: &TaxelSpot<'_>, is_faulty: impl Fn(usize) -> bool) -> bool {
        let (there, pressed) = self.around(spot, 1, 1, &is_faulty);
        if pressed < 3 || there > pressed + 1 {
            return false;
        }
        let (there, pressed) = self.around(spot, 2, 3, &is_faulty);
        pressed >= 3 && (there - pressed) * 5 <= there
    }

    /// True if a neighbour of a taxel is pressed.
    fn is_near_pressure(&self, spot: &TaxelSpot<'_>) -> bool {
        let TaxelSpot { area, row, column, .. } = *spot;
        (row.saturating_sub(1)..=row.saturating_add(1).min(area.rows.saturating_sub(1))).any(|y| {
            (column.saturating_sub(1)..=column.saturating_add(1).min(area.columns.saturating_sub(1))).any(
                |x| {
                    let taxel =
                        usize::from(area.base) + usize::from(y) * usize::from(area.columns) + usize::from(x);
                    taxel != spot.taxel && self.is_pressed(taxel)
                },
            )
        })
    }

    /// Returns the taxels of a group that are to be judged.
    // M0+: out of line
    #[inline(never)]
    pub fn suspects(&self, first: usize, seen: &[Seen]) -> Suspects {
        let (low, high) = (RAIL + 1, self.full.saturating_sub(RAIL + 1));
        let plain =
            |seen: &Seen| seen.is_within(low, high) && !seen.is_still() && seen.travel() <= self.limits.noisy;
        let odd = bits(seen.iter().map(|seen| !plain(seen)));
        let Some(rest) = self.rest.filter(|_| self.touched) else { return Suspects { odd, beside: 0 } };
        // From one taxel before the first on, if there is one.
        let before = usize::from(first > 0);
        let from = first - before;
        let (codes, rest) = self.codes.get(from..).zip(rest.get(from..)).unwrap_or((&[], &[]));
        let pressed = pressed(codes, rest, seen.len() + 1 + before);
        let (left, itself) = if before == 1 { (pressed, pressed >> 1) } else { (pressed << 1, pressed) };
        Suspects { odd, beside: (left | itself >> 1) & !itself }
    }

    /// True if a taxel that is not odd need not be judged: around it, more taxels are not pressed than the
    /// faulty ones and the one that [`Shown::is_covered`] allows.
    // M0+: out of line
    #[inline(never)]
    pub fn is_bare(&self, spot: &TaxelSpot<'_>, faulty: usize) -> bool {
        let TaxelSpot { area, row, column, .. } = *spot;
        let columns = usize::from(area.columns);
        let (top, left) = (row.saturating_sub(1), column.saturating_sub(1));
        let width = usize::from(column.saturating_add(2).min(area.columns) - left);
        let mut first = usize::from(area.base) + usize::from(top) * columns + usize::from(left);
        let rest = self.rest.unwrap_or(&[]);
        // Counts the taxel itself, too.
        let mut count = 0;
        for _ in top..row.saturating_add(2).min(area.rows) {
            let range = first..first + width;
            let (Some(codes), Some(rest)) = (self.codes.get(range.clone()), rest.get(range)) else { break };
            count += idle(codes, rest, self.falling);
            if count > 2 + faulty {
                return true;
            }
            first += columns;
        }
        false
    }

    /// Judges a taxel by its codes while it was watched, and by its healthy neighbours.
    pub fn judge(&self, seen: &Seen, spot: &TaxelSpot<'_>, is_faulty: impl Fn(usize) -> bool) -> TaxelHealth {
        let taxel = spot.taxel;
        let (low, high) = seen.pressure(self.falling.then_some(self.full));
        if low >= self.full.saturating_sub(RAIL) {
            // An object that presses a taxel to full scale presses its neighbours, too.
            let alone = self.rest.is_some() && !self.is_near_pressure(spot);
            return if alone { TaxelHealth::Shorted } else { TaxelHealth::Good };
        }
        if seen.is_still() && high > 0 && self.limits.lively && !is_wide(low) {
            return TaxelHealth::Stuck;
        }
        if seen.travel() > self.limits.noisy && self.is_restless(seen, taxel) {
            return TaxelHealth::Noisy;
        }
        let Some(rest) = self.at_rest(taxel) else { return TaxelHealth::Good };
        if high <= RAIL && rest >= i32::from(SIGNAL) {
            return TaxelHealth::Open;
        }
        // The present frame counts, too: a touch may have begun in it.
        let now = self.codes.get(taxel).map_or(0, |code| self.pressure(code.0));
        if !self.touched || i32::from(high).max(now) - rest > self.limits.idle {
            return TaxelHealth::Good;
        }
        if !self.is_covered(spot, is_faulty) {
            return TaxelHealth::Good;
        }
        if high <= RAIL { TaxelHealth::Open } else { TaxelHealth::Dead }
    }

    /// True if the code got to both sides of that at rest; neither touch nor shaking does that.
    pub fn is_around_rest(&self, seen: &Seen, taxel: usize) -> bool {
        self.rest.and_then(|rest| rest.get(taxel)).is_some_and(|rest| seen.is_around(*rest, RAIL))
    }

    /// True if a code travelled further than a touch takes it, there and back. A pressed taxel may shake in
    /// proportion, by a fifth of its signal; the usual noise is added.
    fn is_restless(&self, seen: &Seen, taxel: usize) -> bool {
        let reach = seen.reach(self.rest.and_then(|rest| rest.get(taxel)).copied());
        let touch = u32::from(reach) * 9 / 4 + self.limits.usual;
        u32::from(seen.travel()) > touch
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::walk::Walk;
    use super::*;
    use crate::garment::{Garment, Layout};
    use fastrand::Rng;
    use std::vec::Vec;

    fn shown<'a>(codes: &'a [Code], rest: &'a [u16]) -> Shown<'a> {
        let limits = Limits::of(20, 1);
        Shown { codes, rest: Some(rest), full: 4095, falling: false, limits, touched: true }
    }

    /// Codes of a garment with three quarters of its taxels pressed, and codes at rest.
    fn images(layout: &Layout, random: &mut Rng) -> (Vec<Code>, Vec<u16>) {
        let codes = (0..layout.taxels()).map(|_| Code(if random.u32(..4) > 0 { 900 } else { 310 }));
        (codes.collect(), (0..layout.taxels()).map(|_| 200 + random.u32(..200) as u16).collect())
    }

    #[test]
    fn those_around_are_those_of_a_ring() {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        let mut random = Rng::with_seed(1);
        for _ in 0..20 {
            let (codes, rest) = images(&layout, &mut random);
            let shown = shown(&codes, &rest);
            let faulty: Vec<usize> = (0..40).map(|_| random.usize(..layout.taxels())).collect();
            let is_faulty = |taxel| faulty.contains(&taxel);
            let mut walk = Walk::new(&layout);
            for spot in (0..layout.taxels()).step_by(3).filter_map(|taxel| walk.to(taxel)) {
                for (distance, missing) in [(1, 1), (2, 3), (2, 100)] {
                    let ring = (0..layout.taxels()).filter(|other| {
                        let place = layout.place(*other).unwrap();
                        let apart = place.row.abs_diff(spot.row).max(place.column.abs_diff(spot.column));
                        place.panel == spot.panel && apart == distance && !is_faulty(*other)
                    });
                    let (mut there, mut pressed) = (0, 0);
                    for other in ring {
                        if there > pressed + missing {
                            break;
                        }
                        there += 1;
                        pressed += u32::from(shown.is_pressed(other));
                    }
                    assert_eq!(
                        shown.around(&spot, distance, missing, is_faulty),
                        (there, pressed),
                        "{spot:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_bare_is_not_covered() {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        let (mut random, mut found) = (Rng::with_seed(3), [0; 4]);
        for _ in 0..40 {
            let (codes, rest) = images(&layout, &mut random);
            let shown = shown(&codes, &rest);
            let faulty: Vec<usize> = (0..2).map(|_| random.usize(..layout.taxels())).collect();
            let mut walk = Walk::new(&layout);
            for spot in (0..layout.taxels()).filter_map(|taxel| walk.to(taxel)) {
                let covered = shown.is_covered(&spot, |taxel| faulty.contains(&taxel));
                let bare = shown.is_bare(&spot, faulty.len());
                assert!(!(bare && covered), "{spot:?}");
                found[usize::from(bare) * 2 + usize::from(covered)] += 1;
            }
        }
        assert!(found[0] > 100 && found[1] > 100 && found[2] > 100, "{found:?}");
    }

    #[test]
    fn those_beside_a_pressed_one_are_suspects() {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        let mut random = Rng::with_seed(2);
        for round in 0..200 {
            let (codes, rest) = images(&layout, &mut random);
            let shown = shown(&codes, &rest);
            let first = if round % 4 == 0 { 0 } else { random.u32(..2048) as usize };
            let mut seen = [Seen::NOTHING; 23];
            for seen in &mut seen {
                seen.begin(Code(300));
                seen.see(Code(if random.u32(..4) == 0 { 300 } else { 302 }));
            }
            let seen = &seen[..23.min(layout.taxels() - first)];
            let is_far =
                |at: usize| codes.get(at).is_some_and(|code| code.0.abs_diff(rest[at]) >= PRESSED as u16);
            let plain = (first..).zip(seen).enumerate().fold((0, 0), |(odd, beside), (at, (taxel, seen))| {
                let is_beside = (taxel > 0 && is_far(taxel - 1)) || is_far(taxel + 1);
                let is_beside = is_beside && !is_far(taxel);
                (odd | u32::from(seen.is_still()) << at, beside | u32::from(is_beside) << at)
            });
            let Suspects { odd, beside } = shown.suspects(first, seen);
            let real = (1 << seen.len()) - 1;
            assert_eq!((odd & real, beside & real), plain, "{first}");
        }
    }
}
