//! How the taxels of a group follow their codes and their panel.

use super::panel::Orders;
use super::patches::Patch;
use super::terms::Terms;
use crate::format::Code;

/// Some taxels of a row: those of a group, at most 32.
pub(super) struct Taxels<'a> {
    pub codes: &'a [Code],
    pub gain: &'a [u16],
    pub rest: &'a mut [u16],
    pub limit: &'a mut [u16],
    pub factor: &'a mut [u8],
    /// A bit for each that a contact holds.
    pub held: u32,
}

impl Taxels<'_> {
    /// Moves their baselines; how far off the furthest of those is that are held.
    #[inline(always)]
    pub fn follow(self, terms: Terms, orders: &Orders, patch: &mut Patch) -> i32 {
        let Orders { shift, lead, teacher, own } = orders;
        let (moves, leads, teaches) = (shift.counts() != 0, *lead != 0, teacher.is_teaching());
        // Half of one count is none: a taxel that is off by no more stays where it is.
        let rests = !moves && !leads && !teacher.levels();
        let (drifts, count) = (patch.drifts(), self.codes.len() as u32);
        let (mut rising, mut strongest, mut back, mut bits) = (0, 0, None, self.held);
        let taxels = self.codes.iter().zip(self.gain).zip(self.rest).zip(self.limit).zip(self.factor);
        for ((((code, gain), rest), limit), factor) in taxels {
            let held = bits & 1 == 1;
            bits >>= 1;
            let (was, code) = (i32::from(*rest), i32::from(code.0));
            let mut off = if terms.falling { was - code } else { code - was };
            if rests && (off + 1) as u32 <= 2 {
                continue;
            }
            let mut step = 0;
            if !rests {
                let factor = *factor;
                step = shift.of(factor);
                off += ((i32::from(factor) * lead) >> 7) - step;
            }
            let near = own.is_near(off);
            let mut alone = own.step(off, held, drifts);
            if teaches && !held {
                *factor = teacher.taught(*factor, if near { alone } else { 0 });
            }
            if held && !near {
                strongest = strongest.max(off);
                alone -= *back.get_or_insert_with(|| patch.give_back());
            } else {
                rising += u32::from(own.rises(off));
            }
            step += alone;
            if step != 0 {
                terms.shift(rest, limit, *gain, step);
            }
        }
        patch.visit(rising, count);
        strongest
    }
}
