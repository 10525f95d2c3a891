//! The baseline follows drift, in counts per second.
//!
//! In each [turn](super::rates::TURN_US) every row is visited once. There each taxel moves by what its panel has drifted, times a
//! [factor](super::factor) of its own, touched or not; and by itself towards its code, as far as that may be drift (see
//! [`Own`](super::own::Own)). What the panel drifts is what its untouched witnesses agree on ([`Common`](super::common::Common)). Only a tared
//! baseline drifts: recordings are taken as they are.

use super::common::{Orders, Shown};
use super::feedback::Feedback;
use super::patches::{GROUP, Patch};
use super::sampled::Sampled;
use super::state::ConditionState;
use super::terms::Terms;
use crate::format::Code;
use crate::garment::{Area, Layout};

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Lets the rows whose turn it is follow their codes.
    pub(super) fn follow_drift<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) {
        let last = layout.areas().last();
        let rows = last.map_or(0, |area| area.first_row.saturating_add(area.rows));
        if !self.tracking.tared {
            return;
        }
        while let Some(turn) = self.turn.next(sampled.now, rows) {
            let here = (0u8..).zip(layout.areas()).find_map(|(panel, area)| {
                let row = turn.checked_sub(area.first_row).filter(|row| *row < area.rows)?;
                Some((panel, area, row))
            });
            if let Some((panel, area, row)) = here
                && sampled.panels >> panel & 1 == 1
            {
                if row == 0 {
                    self.ask(layout, (panel, area), sampled, feedback, terms);
                }
                self.follow((panel, area, row), sampled, feedback, terms);
            }
        }
    }

    /// Asks the panel what its rows are to do.
    fn ask<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        (panel, area): (u8, &Area),
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) {
        let shown = Shown {
            area,
            codes: sampled.codes,
            baseline: &self.baseline,
            gain: &self.gain,
            factor: &self.factor,
            terms,
            now: sampled.now,
            touched: feedback.is_on(panel),
        };
        let first = usize::from(area.base);
        self.common.ask(panel, &shown, |at| {
            let place = || layout.place(first + at);
            shown.touched && place().is_some_and(|place| feedback.holds(panel, place.row, place.column))
        });
    }

    fn follow<const CONTACTS: usize>(
        &mut self,
        (panel, area, row): (u8, &Area, u16),
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) {
        let Some(orders) = self.common.orders(panel) else { return };
        if feedback.touches(panel, row, 0, area.columns) {
            let strongest = self.follow_row(area, row, sampled.codes, terms, &orders, |column| {
                feedback.holds(panel, row, column)
            });
            self.common.felt(panel, strongest);
        } else {
            self.follow_row(area, row, sampled.codes, terms, &orders, |_| false);
        }
    }

    /// Moves the baselines of a row, of which some columns are held by a contact; how far off the furthest of those is.
    #[inline(always)]
    fn follow_row(
        &mut self,
        area: &Area,
        row: u16,
        codes: &[Code],
        terms: Terms,
        orders: &Orders,
        held: impl Fn(u16) -> bool,
    ) -> u16 {
        let columns = usize::from(area.columns);
        let first = usize::from(area.base) + usize::from(row) * columns;
        let groups = columns / GROUP;
        // Groups of a panel that is narrower tell nothing.
        let mut patches = self.patches.get_mut(usize::from(area.base) / GROUP + usize::from(row) * groups..);
        let mut strongest = 0;
        let (mut from, mut before) = (0, false);
        while from < columns {
            // The last one takes what is left of the row.
            let to = if from + 2 * GROUP <= columns { from + GROUP } else { columns };
            let there = first + from..(first + to).min(codes.len());
            let (Some(rest), Some(limit), Some(factor), Some(gain), Some(codes)) = (
                self.baseline.get_mut(there.clone()),
                self.limit.get_mut(there.clone()),
                self.factor.get_mut(there.clone()),
                self.gain.get(there.clone()),
                codes.get(there),
            ) else {
                break;
            };
            let taxels = Taxels { codes, gain, rest, limit, factor };
            let mut none = [Patch::NONE];
            let known = match patches.as_mut() {
                Some(patches) if groups > 0 && !patches.is_empty() => &mut **patches,
                _ => &mut none,
            };
            let next = known.get(1).filter(|_| to < columns).is_some_and(|next| next.drifts());
            let Some(patch) = known.first_mut() else { break };
            if next || before {
                patch.spread();
            }
            before = patch.drifts();
            strongest = strongest.max(taxels.follow(terms, orders, patch, |at| held((from + at) as u16)));
            patches = patches.and_then(|patches| patches.get_mut(1..));
            from = to;
        }
        strongest.clamp(0, 0xffff) as u16
    }
}

/// Some taxels of a row: those of a group.
struct Taxels<'a> {
    codes: &'a [Code],
    gain: &'a [u16],
    rest: &'a mut [u16],
    limit: &'a mut [u16],
    factor: &'a mut [u8],
}

impl Taxels<'_> {
    /// Moves their baselines; how far off the furthest of those is that are held.
    fn follow(self, terms: Terms, orders: &Orders, patch: &mut Patch, held: impl Fn(usize) -> bool) -> i32 {
        let Orders { shift, lead, teacher, own } = orders;
        let (moves, leads, teaches) = (shift.counts() != 0, lead.counts() != 0, teacher.is_teaching());
        let (drifts, count) = (patch.drifts(), self.codes.len() as u32);
        let (mut rising, mut strongest, mut back) = (0, 0, None);
        let taxels = self.codes.iter().zip(self.gain).zip(self.rest).zip(self.limit).zip(self.factor);
        for (at, ((((code, gain), rest), limit), factor)) in taxels.enumerate() {
            let (was, code) = (i32::from(*rest), i32::from(code.0));
            let with_panel = if moves { shift.of(*factor) } else { 0 };
            let ahead = if leads { lead.of(*factor) } else { 0 };
            let off = if terms.falling { was - code } else { code - was } - with_panel + ahead;
            let held = held(at);
            let mut alone = own.step(off, held, drifts);
            if teaches && !held {
                let lesson = if own.is_near(off) { alone } else { 0 };
                *factor = teacher.taught(*factor, lesson);
            }
            if held && !own.is_near(off) {
                strongest = strongest.max(off);
                alone -= *back.get_or_insert_with(|| patch.give_back());
            } else {
                rising += u32::from(own.rises(off));
            }
            terms.shift(rest, limit, *gain, with_panel + alone);
        }
        patch.visit(rising, count);
        strongest
    }
}
