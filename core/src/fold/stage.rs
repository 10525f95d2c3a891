//! Expected pressure on the taxels that fold, and its corrections.

use super::bend::{Bend, Corner, Due};
use super::corners::{AT_ONCE, Around, add_means, find_doubts, find_ends};
use super::lanes::{LaneSums, LevelPairs, byte, zeros};
use super::lesson::{Lesson, MOST_PASSES};
use super::posture::PostureState;
#[cfg(feature = "folds")]
use super::posture::{JointAngle, Posture};
use super::quads::{Change, Quad, change, compare, expect, hold_all, raise, sum_levels, take_doubts};
use super::record::{FoldRecord, NO_JOINT};
use super::table::{FoldStart, FoldTable};
use super::{CELLS, FOLDED, FOLDS, JOINTS, KNOTS};
use crate::capacity::TAXELS;
use crate::format::Micros;
#[cfg(feature = "folds")]
use crate::format::{Invalid, Name, name};
use core::ops::Range;
use serde::{Deserialize, Serialize};

/// Time in which every taxel that folds is renewed, us.
const TURN_US: u64 = 20_000;
/// 1 if this build has a use for tables, else 0.
const USED: usize = if cfg!(feature = "folds") { 1 } else { 0 };
/// Words of a bit for each taxel.
const WORDS: usize = if cfg!(feature = "folds") { TAXELS.div_ceil(32) } else { 0 };
/// Joints of a table.
const KNOWN: usize = if cfg!(feature = "folds") { JOINTS } else { 0 };

/// Sums of what is expected at the present posture.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Expected {
    /// Number of taxels of which something is expected, or that are in doubt.
    pub taxels: u16,
    /// Sum of the expected pressures, counts.
    pub total: u32,
    /// Sum of the doubts, counts.
    pub doubt: u32,
}

/// By how much the total of a contact may be off for the folds beneath it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Doubt {
    /// Id of the contact.
    pub id: u32,
    /// Sum of the doubts of its taxels, counts.
    pub doubt: u32,
}

/// Expectation, doubt and corrections of the taxels that fold.
#[derive(Debug, Clone)]
pub struct FoldState {
    /// Angles of the joints.
    pub posture: PostureState,
    /// The table in force, if there is one, and what turns: without the feature there is no room for them.
    in_force: [InForce; USED],
    /// Number in the scene of each joint of the table.
    joints: [Option<u8>; KNOWN],
    bends: [Bend; FOLDS],
    /// Corrections of the cells' means, in units of the table and 128 more, as the rows of the table lie.
    /// 0 for a cell that was not compared yet: one that was touched whenever its joint came there.
    corrections: [u32; CELLS / 4],
    /// Comparisons so far at each knot, at most [`MOST_PASSES`].
    passes: [u8; KNOTS],
    /// Expected pressure around the posture, see [`LaneSums::ends`]: from knot to knot of a fold of one joint,
    /// all together, without a step, of one of two.
    ends: [[LaneSums; 2]; FOLDED / 4],
    /// Expectations and doubts of four taxels each.
    quads: [Quad; FOLDED / 4],
    /// A bit for each taxel of which something is expected, or that is in doubt.
    held: [u32; WORDS],
}

/// A table in force, and whose turn it is.
#[derive(Debug, Clone, Copy)]
struct InForce {
    table: Option<FoldTable<'static>>,
    /// Taxels renewed in the last frame, each four of the table's list: from the first to before the second,
    /// which follows.
    turn: [u16; 2],
    renewed: Option<Micros>,
    is_posed: bool,
}

impl InForce {
    const NOTHING: InForce = InForce { table: None, turn: [0; 2], renewed: None, is_posed: false };
}

impl FoldState {
    /// Nothing folds.
    pub const fn new() -> FoldState {
        FoldState {
            posture: PostureState::new(),
            in_force: [InForce::NOTHING; USED],
            joints: [None; KNOWN],
            bends: [Bend::NONE; FOLDS],
            corrections: [0; CELLS / 4],
            passes: [0; KNOTS],
            ends: [[LaneSums::ZERO; 2]; FOLDED / 4],
            quads: [Quad::NONE; FOLDED / 4],
            held: [0; WORDS],
        }
    }

    /// Puts a table in force, or none; `joints` are the scene's. Corrections are forgotten.
    #[cfg(feature = "folds")]
    pub(crate) fn use_folds(&mut self, table: Option<FoldTable<'static>>, joints: &[Name]) {
        self.in_force.fill(InForce { table, ..InForce::NOTHING });
        self.joints = [None; KNOWN];
        for (joint, to) in (0..).zip(&mut self.joints) {
            let called = table.and_then(|table| table.joint(joint));
            let at = called.and_then(|called| joints.iter().position(|joint| joint == called));
            *to = at.map(|at| at as u8);
        }
        self.forget();
    }

    /// Puts a table in force at these angles of its joints, hundredths of a degree, and expects at once what it
    /// says: for who has no board to pass frames to.
    #[cfg(feature = "folds")]
    pub fn pose(&mut self, table: FoldTable<'static>, angles: &[i16]) -> Result<(), Invalid> {
        let (mut joints, mut posture) = (heapless::Vec::<Name, JOINTS>::new(), Posture::default());
        for (joint, centidegrees) in (0..).zip(angles.iter().copied()) {
            // There are as many places as joints.
            let _ = joints.push(name(table.joint(joint).unwrap_or_default()));
            let _ = posture.joints.push(JointAngle { joint, centidegrees });
        }
        self.use_folds(Some(table), &joints);
        self.posture.accept(&posture, &joints, Micros(0))?;
        self.begin(Micros(0), true);
        self.renew(None::<fn(&[u16; 4]) -> u32>, |_, _| ());
        Ok(())
    }

    /// Forgets all corrections: a new day. The posture stays.
    #[inline(never)] // seldom
    pub(crate) fn forget(&mut self) {
        if !cfg!(feature = "folds") {
            return;
        }
        self.corrections.fill(0);
        self.passes.fill(0);
        // Not `fill`, whose loops the compiler unrolls.
        self.bends = [Bend::NONE; FOLDS];
        self.quads = [Quad::NONE; FOLDED / 4];
        self.held.fill(0);
        self.in_force
            .iter_mut()
            .for_each(|active| *active = InForce { table: active.table, ..InForce::NOTHING });
    }

    /// The table in force.
    pub fn table(&self) -> Option<FoldTable<'static>> {
        self.in_force.first()?.table
    }

    /// True if the folds are known at the present posture: contacts then mean something while joints move.
    pub fn is_followed(&self) -> bool {
        self.in_force.first().is_some_and(|active| active.table.is_some() && active.is_posed)
    }

    /// True if something is expected of a taxel, or it is in doubt: its baseline does not follow its code.
    pub(crate) fn holds(&self, taxel: usize) -> bool {
        self.held.get(taxel / 32).is_some_and(|word| word >> (taxel % 32) & 1 == 1)
    }

    /// True if [`FoldState::holds`] any of these taxels.
    pub(crate) fn holds_any(&self, taxels: Range<usize>) -> bool {
        self.table().is_some() && has_any(&self.held, taxels)
    }

    /// Gives some taxels, or all of them if `whole`, their turn: see [`FoldState::turn`].
    pub(crate) fn begin(&mut self, now: Micros, whole: bool) {
        let Some(active) = self.in_force.first_mut() else { return };
        let Some(table) = active.table else { return };
        let all = table.taxels().len() as u16;
        let since = active.renewed.map_or(TURN_US, |renewed| now.since(renewed).min(TURN_US)) as u32;
        let share = (u32::from(all) * since).div_ceil(TURN_US as u32) as u16;
        let count = if whole { all } else { share.clamp(1, all.max(1)) };
        let [_, end] = active.turn;
        let start = if end >= all { 0 } else { end };
        let turn = [start, start.saturating_add(count).min(all)];
        let is_posed = self.posture.is_fresh(now);
        *active = InForce { table: Some(table), turn, renewed: Some(now), is_posed };
        if whole {
            self.bends.iter_mut().for_each(Bend::set);
        }
    }

    /// All taxels are due in their next turn, whether anything changes or not.
    #[cfg(test)]
    pub(crate) fn renew_all(&mut self) {
        for bend in &mut self.bends {
            bend.renew();
            bend.set();
        }
    }

    /// Numbers of taxels among which are those whose turn it is.
    pub(crate) fn turn(&self) -> Range<usize> {
        let Some(InForce { table: Some(table), turn: [start, end], .. }) = self.in_force.first() else {
            return 0..0;
        };
        let turn = table.taxels().get(usize::from(*start)..usize::from(*end)).unwrap_or(&[]);
        let all = turn
            .iter()
            .fold((u16::MAX, 0), |(from, to), [first, .., last]| (from.min(*first), to.max(*last)));
        all.0.into()..usize::from(all.1) + 1
    }

    /// Renews those of the taxels whose turn it is of which something may have changed since their last turn,
    /// and hands over some at a time, in fours, with the levels beyond which a touch begins there, counts, or
    /// goes on where `touched` has all bits of their bytes; none if nothing touches the garment.
    #[inline(never)]
    pub(crate) fn renew<T: Fn(&[u16; 4]) -> u32>(
        &mut self,
        touched: Option<T>,
        mut set: impl FnMut(&[[u16; 4]], &[LevelPairs]),
    ) {
        let Some(InForce { table: Some(table), turn, is_posed, .. }) = self.in_force.first().copied() else {
            return;
        };
        let mut at = FoldStart::FIRST;
        for (index, fold) in table.folds().iter().enumerate() {
            let angle = |joint: u8| {
                let joint = self.joints.get(usize::from(joint)).copied().flatten()?;
                self.posture.angle(joint.into())
            };
            let angles = if is_posed { fold.joints.map(angle) } else { [None; 2] };
            let Some(bend) = self.bends.get_mut(index) else { break };
            bend.turn(fold, angles);
            let quads = within(&at, fold, turn);
            let due = bend.due(fold, quads.len(), touched.is_some());
            if !due.is_nothing() && !quads.is_empty() {
                let mut known = *bend;
                // A touch that is there is in no doubt, unless the posture is unknown.
                let certain = touched.as_ref().filter(|_| known.is_known);
                self.renew_fold(&table, (fold, &at, &mut known), (due, quads), certain, &mut set);
                if let Some(bend) = self.bends.get_mut(index) {
                    bend.has_certain = known.has_certain;
                }
            }
            at = at.after(fold);
        }
    }

    /// Renews taxels of a fold.
    #[inline(never)] // own stack
    fn renew_fold<T: Fn(&[u16; 4]) -> u32>(
        &mut self,
        table: &FoldTable<'_>,
        (fold, at, bend): (&FoldRecord, &FoldStart, &mut Bend),
        (due, mut quads): (Due, Range<usize>),
        certain: Option<&T>,
        set: &mut impl FnMut(&[[u16; 4]], &[LevelPairs]),
    ) {
        let (unit, mut levels) = (u32::from(table.unit()), [[0; 2]; AT_ONCE]);
        while !quads.is_empty() {
            let some = quads.start..quads.end.min(quads.start + AT_ONCE);
            quads.start = some.end;
            let taxels = table.taxels().get(some.clone()).unwrap_or(&[]);
            if due.doubt || due.knots && !bend.is_known {
                bend.has_certain |= self.doubt(table, (fold, at, bend), &some);
            }
            let own = self.quads.get_mut(some.clone()).unwrap_or_default();
            match certain {
                Some(certain) => raise(own, taxels, certain),
                None if due.touch => raise(own, taxels, |_| 0),
                None => {}
            }
            if due.knots || due.doubt || due.posture {
                self.expect(table, (fold, at, bend), due.knots, &some, &mut levels);
            } else {
                sum_levels(own, unit, &mut levels);
            }
            set(taxels, &levels);
        }
    }

    /// Renews the doubts of some quads of a fold. True if some taxel is in no doubt.
    #[inline(never)] // own stack
    fn doubt(
        &mut self,
        table: &FoldTable<'_>,
        (fold, at, bend): (&FoldRecord, &FoldStart, &Bend),
        quads: &Range<usize>,
    ) -> bool {
        let own = quads.start - at.quad..quads.end - at.quad;
        let corrections = &self.corrections;
        let around = |corner: &Corner| around((table, fold, at), corrections, &own, corner);
        let there = || bend.corners.iter().filter(|corner| corner.weight > 0);
        let mut found = [0; AT_ONCE];
        let doubts = if bend.is_known {
            let passes = there().filter_map(|corner| self.passes.get(at.knot + usize::from(corner.knot)));
            let nearest = around(&Corner { knot: bend.doubted_at, weight: 0 });
            find_doubts(&mut found, nearest, passes.min().copied().unwrap_or(0), there().map(around));
            &found
        } else {
            // Taxels may feel anything up to the most.
            table.most(fold, at).and_then(|most| most.get(own.clone())).unwrap_or(&found)
        };
        let taxels = table.taxels().get(quads.clone()).unwrap_or(&[]);
        take_doubts(self.quads.get_mut(quads.clone()).unwrap_or_default(), doubts, taxels, &mut self.held)
    }

    /// Renews what is expected of some quads of a fold, and their levels; `knots`: the knots are others.
    fn expect(
        &mut self,
        table: &FoldTable<'_>,
        (fold, at, bend): (&FoldRecord, &FoldStart, &Bend),
        knots: bool,
        quads: &Range<usize>,
        levels: &mut [LevelPairs],
    ) {
        let own = quads.start - at.quad..quads.end - at.quad;
        let corrections = &self.corrections;
        let around = |corner: &Corner| around((table, fold, at), corrections, &own, corner);
        let (its, unit) = (self.quads.get_mut(quads.clone()).unwrap_or_default(), u32::from(table.unit()));
        let ends = self.ends.get_mut(quads.clone()).unwrap_or_default();
        let [first, _, last, _] = &bend.corners;
        let mut weight = 0;
        if !bend.is_known {
            // Nothing is expected: sums of 0 are below a byte.
            ends.fill([LaneSums::ZERO; 2]);
        } else if fold.joints[1] != NO_JOINT {
            ends.fill([LaneSums::NONE, LaneSums::ZERO]);
            let there = bend.corners.iter().filter(|corner| corner.weight > 0);
            there.for_each(|corner| add_means(ends, around(corner)));
        } else {
            weight = last.weight.into();
            if knots {
                let (first, last) = (around(first), around(last));
                // There is no knot after the last one, which then counts nothing.
                find_ends(ends, first, if last.cells.is_empty() { first } else { last });
            }
        }
        expect(its, (ends, weight), unit, levels);
        if bend.has_certain {
            hold_all(its, table.taxels().get(quads.clone()).unwrap_or(&[]), &mut self.held);
        }
    }

    /// Hands over each taxel of which something is expected or in doubt, with its expectation, counts.
    pub(crate) fn each(&self, mut take: impl FnMut(usize, u16)) {
        let Some(table) = self.table() else { return };
        for (taxels, Quad { expected, doubt, .. }) in table.taxels().iter().zip(&self.quads) {
            let (mut any, mut expected) = (expected | doubt, *expected);
            if any == 0 {
                continue;
            }
            for taxel in taxels {
                if any & 0xFF != 0 {
                    take(usize::from(*taxel), (expected as u8 as u16).saturating_mul(table.unit()));
                }
                (any, expected) = (any >> 8, expected >> 8);
            }
        }
    }

    /// Level beyond which a touch begins on a taxel, counts.
    #[inline(never)] // seldom
    pub(crate) fn level(&self, taxel: usize) -> u16 {
        let slot = if self.holds(taxel) { self.slot(taxel as u16) } else { None };
        let of = |slot: usize| {
            let Quad { expected, raised, .. } = self.quads.get(slot / 4)?;
            let units = [*expected, *raised].map(|bytes| u16::from(byte(bytes, slot % 4)));
            Some(units.iter().sum::<u16>().saturating_mul(self.table()?.unit()))
        };
        slot.and_then(of).unwrap_or(0)
    }

    /// Makes of the values of the taxels that press, counts, what they feel less what is expected of them.
    /// `beyond_levels`: a value is what a taxel feels beyond its level, and that holds the doubt, too.
    /// Otherwise it is all that it feels.
    #[inline(never)] // own registers
    pub fn subtract(&self, values: &mut [u16], beyond_levels: bool) {
        let Some(table) = self.table() else { return };
        let unit = u32::from(table.unit());
        let how = if beyond_levels { Change::Raise } else { Change::Lower };
        let mut at = FoldStart::FIRST;
        for fold in table.folds() {
            let quads = at.quads(fold);
            at = at.after(fold);
            let taxels = table.taxels().get(quads.clone()).unwrap_or(&[]);
            change(values, (taxels, self.quads.get(quads).unwrap_or(&[])), unit, how);
        }
    }

    /// True if taxels are to be compared with what is expected of them.
    pub(crate) fn compares(&self) -> bool {
        self.table().is_some() && self.bends.iter().any(|bend| bend.is_known && bend.left > 0)
    }

    /// Compares the taxels whose turn it was and whose joint has come to another knot with what they feel.
    /// `felt` gives the pressures of four taxels without the expectations, counts, and a bit for each of them
    /// that may be compared: it is not touched.
    #[inline(never)]
    pub(crate) fn learn(&mut self, felt: impl Fn(&[u16; 4]) -> (u32, [u16; 4])) {
        let Some(InForce { table: Some(table), turn, .. }) = self.in_force.first().copied() else { return };
        let mut at = FoldStart::FIRST;
        for (index, fold) in table.folds().iter().enumerate() {
            let Some(bend) = self.bends.get_mut(index) else { break };
            let knot = usize::from(bend.knot.unwrap_or(0));
            let Some(passes) = self.passes.get_mut(at.knot + knot) else { break };
            if bend.is_known && bend.left > 0 {
                let quads = within(&at, fold, turn);
                let quads = quads.start..quads.end.min(quads.start + usize::from(bend.left));
                let first = at.correction + knot * fold.quads() + quads.start - at.quad;
                let corrections = self.corrections.get_mut(first..first + quads.len()).unwrap_or_default();
                let taxels = table.taxels().get(quads.clone()).unwrap_or(&[]);
                let expected = self.quads.get(quads.clone()).unwrap_or(&[]);
                let lesson = Lesson::of(table.unit(), *passes);
                for ((taxels, Quad { expected, .. }), corrections) in
                    taxels.iter().zip(expected).zip(corrections)
                {
                    let (known, felt) = felt(taxels);
                    if known != 0 {
                        *corrections = compare(known, &felt, *expected, *corrections, lesson);
                        bend.compared += known.count_ones() as u16;
                    }
                }
                bend.renew();
                bend.left -= quads.len() as u16;
                // A comparison in which most taxels may have been touched is none.
                if bend.left == 0 && bend.compared > fold.taxels / 2 {
                    *passes = (*passes + 1).min(MOST_PASSES);
                }
            }
            at = at.after(fold);
        }
    }

    /// Expectation of a taxel and its doubt, counts; none if it does not fold.
    pub fn of(&self, taxel: u16) -> Option<[u16; 2]> {
        let (table, slot) = (self.table()?, self.slot(taxel)?);
        let Quad { expected, doubt, .. } = self.quads.get(slot / 4)?;
        Some([*expected, *doubt].map(|bytes| u16::from(byte(bytes, slot % 4)).saturating_mul(table.unit())))
    }

    /// Position of a taxel in the table's list; none if it does not fold.
    fn slot(&self, taxel: u16) -> Option<usize> {
        let table = self.table()?;
        let mut start = FoldStart::FIRST;
        table.folds().iter().find_map(|fold| {
            let here = start;
            start = start.after(fold);
            Some(4 * here.quad + table.place(fold, &here, taxel)?)
        })
    }

    /// Sum of the doubts of the taxels within a range, counts.
    #[cfg(feature = "folds")]
    pub(crate) fn doubt_within(&self, taxels: &Range<usize>) -> u32 {
        let Some(table) = self.table() else { return 0 };
        let mut at = FoldStart::FIRST;
        let mut sum = 0;
        for fold in table.folds() {
            let quads = at.quads(fold);
            at = at.after(fold);
            let its = table.taxels().get(quads.clone()).unwrap_or(&[]);
            // Most ranges lie beside the fold.
            let ([first, ..], [.., last]) = (its.first().unwrap_or(&[0; 4]), its.last().unwrap_or(&[0; 4]));
            if usize::from(*first) >= taxels.end || usize::from(*last) < taxels.start {
                continue;
            }
            let first = its.partition_point(|[.., last]| usize::from(*last) < taxels.start);
            let doubts = self.quads.get(quads.start + first..quads.end).unwrap_or(&[]);
            for (its, Quad { doubt, .. }) in its.iter().skip(first).zip(doubts) {
                let [first, .., last] = its.map(usize::from);
                if first >= taxels.end {
                    break;
                }
                if last.wrapping_sub(first) == 3 {
                    // Without the lanes before the range, and those after it.
                    let before = taxels.start.saturating_sub(first);
                    let after = (last + 1).saturating_sub(taxels.end);
                    let mut own = LaneSums::ZERO;
                    own.add(doubt >> (8 * before) << (8 * (before + after)), 1);
                    sum += own.total();
                    continue;
                }
                for (lane, taxel) in its.iter().enumerate() {
                    if taxels.contains(&usize::from(*taxel)) {
                        sum += u32::from(byte(*doubt, lane));
                    }
                }
            }
        }
        sum * u32::from(table.unit())
    }

    /// Sums over all taxels.
    pub fn expected(&self) -> Expected {
        let Some(table) = self.table() else { return Expected::default() };
        let quads = self.quads.get(..table.taxels().len()).unwrap_or(&self.quads);
        let mut sums = [LaneSums::ZERO; 3];
        for Quad { expected, doubt, .. } in quads {
            let nothing = zeros(expected | doubt) >> 7;
            for (sum, bytes) in sums.iter_mut().zip([nothing, *expected, *doubt]) {
                sum.add(bytes, 1);
            }
        }
        let [nothing, expected, doubt] = sums.map(LaneSums::total);
        let (taxels, unit) = ((4 * quads.len()) as u32 - nothing, u32::from(table.unit()));
        Expected { taxels: taxels as u16, total: expected * unit, doubt: doubt * unit }
    }
}

impl Default for FoldState {
    fn default() -> Self {
        FoldState::new()
    }
}

/// Some quads of a fold at a knot.
#[inline(never)] // M0+: once, for size
fn around<'a>(
    (table, fold, at): (&FoldTable<'a>, &FoldRecord, &FoldStart),
    corrections: &'a [u32],
    own: &Range<usize>,
    corner: &Corner,
) -> Around<'a> {
    let knot = usize::from(corner.knot);
    let first = at.correction + knot * fold.quads();
    let cells = table.knot(fold, at, knot).and_then(|cells| cells.get(own.clone()));
    let corrections = corrections.get(first + own.start..first + own.end);
    Around {
        cells: cells.unwrap_or(&[]),
        corrections: corrections.unwrap_or(&[]),
        weight: corner.weight.into(),
    }
}

/// The fold's quads within a range of the table's.
fn within(start: &FoldStart, fold: &FoldRecord, [first, end]: [u16; 2]) -> Range<usize> {
    let own = start.quads(fold);
    own.start.max(first.into())..own.end.min(end.into())
}

/// True if a bit of a range is set.
fn has_any(words: &[u32], bits: Range<usize>) -> bool {
    let Range { start: mut at, end } = bits;
    while at < end {
        let Some(word) = words.get(at / 32) else { break };
        let own = if end - at < 32 { (1 << (end - at)) - 1 } else { u32::MAX };
        if word >> (at % 32) & own != 0 {
            return true;
        }
        at = (at | 31) + 1;
    }
    false
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn a_range_has_a_bit_if_one_of_its_own_is_set() {
        let words = [1 << 31, 0, 1 | 1 << 17];
        let is_set = |at: usize| words.get(at / 32).is_some_and(|word| word >> (at % 32) & 1 == 1);
        for (start, end) in (0..100).flat_map(|start| (0..130).map(move |end| (start, end))) {
            assert_eq!(has_any(&words, start..end), (start..end).any(is_set), "{start}..{end}");
        }
    }
}
