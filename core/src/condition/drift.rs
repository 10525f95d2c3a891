//! The baseline follows drift, in counts per second.
//!
//! In each [turn](super::rates::TURN_US) every row is visited once. There each taxel moves by what its panel has drifted,
//! times a [factor](super::factor) of its own, touched or not; and by itself towards its code, as far as that may be
//! drift (see [`Own`](super::own::Own)). What the panel drifts is what its untouched witnesses agree on: they are asked
//! as their rows are visited, so that all frames cost alike, and after its last row the panel
//! [decides](super::panel::Panel::decide). Only a tared baseline drifts: recordings are taken as they are.

use super::feedback::Feedback;
use super::patches::{GROUP, Patch};
use super::sampled::Sampled;
use super::slices::panel_of;
use super::state::ConditionState;
use super::taxels::Taxels;
use super::terms::Terms;
use super::witness::Seen;
use crate::garment::{Area, Layout};

/// A row of a panel.
#[derive(Clone, Copy)]
struct Here<'a> {
    panel: u8,
    area: &'a Area,
    row: u16,
    touched: bool,
}

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Lets the rows whose turn it is follow their codes.
    pub(super) fn follow_drift<const CONTACTS: usize>(
        &mut self,
        layout: &Layout,
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) {
        if !self.tracking.tared {
            return;
        }
        // After the rows of a panel comes its decision.
        let panels = layout.areas().len() as u16;
        let last = layout.areas().last().map_or(0, |area| area.first_row.saturating_add(area.rows));
        while let Some(slot) = self.turn.next(sampled.now, last.saturating_add(panels)) {
            let here = (0u8..).zip(layout.areas()).find_map(|(panel, area)| {
                let row = slot.checked_sub(area.first_row.saturating_add(panel.into()))?;
                (row <= area.rows).then_some((panel, area, row))
            });
            let Some((panel, area, row)) = here.filter(|(panel, ..)| sampled.panels >> panel & 1 == 1) else {
                continue;
            };
            if row == area.rows {
                self.common.decide(panel, sampled.now, feedback.is_on(panel), terms.floor);
            } else {
                let touched = feedback.touches(panel, row, 0, area.columns);
                self.visit(Here { panel, area, row, touched }, sampled, feedback, terms);
            }
        }
    }

    #[inline(never)] // M0+: out of line
    fn visit<const CONTACTS: usize>(
        &mut self,
        here: Here<'_>,
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) {
        let Here { panel, row, .. } = here;
        if row == 0 {
            self.common.begin(panel, terms.floor);
        }
        self.ask(here, sampled, feedback, terms);
        let strongest = self.follow_row(here, sampled, feedback, terms);
        if here.touched {
            self.common.felt(panel, strongest);
        }
    }

    /// Asks the witnesses of a row.
    fn ask<const CONTACTS: usize>(
        &mut self,
        here: Here<'_>,
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) {
        let Here { panel, area, row, touched } = here;
        let columns = usize::from(area.columns);
        let first = usize::from(row) * columns;
        let (codes, gain) = (panel_of(sampled.codes, area), panel_of(&self.gain, area));
        let (baseline, factor) = (panel_of(&self.baseline, area), panel_of(&self.factor, area));
        let taxels = usize::from(area.rows) * columns;
        self.common.ask(panel, (first..first + columns, taxels), terms, |at, orders| {
            gain.get(at).filter(|gain| **gain != 0)?;
            let (code, rest, factor) = (codes.get(at)?, baseline.get(at)?, *factor.get(at)?);
            let up = |value: u16| i32::from(if terms.falling { 0xffff - value } else { value });
            let ahead = (i32::from(factor) * orders.lead) >> 7;
            let expected = up(*rest) + orders.shift.of(factor) - ahead;
            let held = touched && feedback.holds(panel, row, (at - first) as u16);
            Some(Seen { expected, off: up(code.0) - expected, factor, held })
        });
    }

    /// Moves the baselines of a row; how far off the furthest of those is that a contact holds.
    #[inline(always)]
    fn follow_row<const CONTACTS: usize>(
        &mut self,
        here: Here<'_>,
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
        terms: Terms,
    ) -> u16 {
        let Here { panel, area, row, touched } = here;
        let Some(orders) = self.common.orders(panel) else { return 0 };
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
            let there = first + from..(first + to).min(sampled.codes.len());
            let (Some(rest), Some(limit), Some(factor), Some(gain), Some(codes)) = (
                self.baseline.get_mut(there.clone()),
                self.limit.get_mut(there.clone()),
                self.factor.get_mut(there.clone()),
                self.gain.get(there.clone()),
                sampled.codes.get(there),
            ) else {
                break;
            };
            let held = if touched { feedback.held_columns(panel, row, from as u16) } else { 0 };
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
            let taxels = Taxels { codes, gain, rest, limit, factor, held };
            strongest = strongest.max(taxels.follow(terms, orders, patch));
            patches = patches.and_then(|patches| patches.get_mut(1..));
            from = to;
        }
        strongest.clamp(0, 0xffff) as u16
    }
}
