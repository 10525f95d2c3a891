//! What the taxels that fold are expected to feel, and its corrections.

use super::bend::Bend;
use super::lanes::{LaneSums, LevelPairs, WHOLE, ZERO, byte, summed, whole_bytes, zeros};
use super::lesson::{Lesson, MOST_PASSES};
use super::posture::PostureState;
use super::record::FoldRecord;
use super::table::{FoldStart, FoldTable};
use super::{CELLS, FOLDED, FOLDS, JOINTS, KNOTS};
use crate::capacity::TAXELS;
use crate::format::Micros;
#[cfg(feature = "folds")]
use crate::format::Name;
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
/// Quads that are renewed at once.
const AT_ONCE: usize = 16;

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
    /// Corrections of the cells' means, in units of the table and [`ZERO`] more, as the rows of the table lie.
    /// 0 for a cell that was not compared yet: one that was touched whenever its joint came there.
    corrections: [u32; CELLS / 4],
    /// Comparisons so far at each knot, at most [`MOST_PASSES`].
    passes: [u8; KNOTS],
    /// Expectations and doubts of four taxels each, in units of the table.
    felt: [[u32; 2]; FOLDED / 4],
    /// The doubts that are part of the levels of four taxels each: all but those of a touch that was there.
    raised: [u32; FOLDED / 4],
    /// A bit for each taxel of which something is expected, or that is in doubt.
    held: [u32; WORDS],
}

/// A table in force, and whose turn it is.
#[derive(Debug, Clone, Copy)]
struct InForce {
    table: Option<FoldTable<'static>>,
    /// What was renewed in the last frame, each four taxels of the table's list: from the first to before the
    /// second, which follows.
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
            felt: [[0; 2]; FOLDED / 4],
            raised: [0; FOLDED / 4],
            held: [0; WORDS],
        }
    }

    /// Puts a table in force, or none; `joints` are the scene's. Corrections are forgotten.
    #[cfg(feature = "folds")]
    pub(crate) fn wear(&mut self, table: Option<FoldTable<'static>>, joints: &[Name]) {
        self.in_force.fill(InForce { table, ..InForce::NOTHING });
        self.joints = [None; KNOWN];
        for (joint, to) in (0..).zip(&mut self.joints) {
            let called = table.and_then(|table| table.joint(joint));
            let at = called.and_then(|called| joints.iter().position(|joint| joint == called));
            *to = at.map(|at| at as u8);
        }
        self.forget();
    }

    /// Forgets all corrections: a new day. The posture stays.
    pub(crate) fn forget(&mut self) {
        if !cfg!(feature = "folds") {
            return;
        }
        self.corrections.fill(0);
        self.passes.fill(0);
        self.bends.fill(Bend::NONE);
        self.felt.fill([0; 2]);
        self.raised.fill(0);
        self.held.fill(0);
        self.in_force.iter_mut().for_each(|worn| *worn = InForce { table: worn.table, ..InForce::NOTHING });
    }

    /// The table in force.
    pub fn table(&self) -> Option<FoldTable<'static>> {
        self.in_force.first()?.table
    }

    /// True if the folds are known at the present posture: contacts then mean something while joints move.
    pub fn is_followed(&self) -> bool {
        self.in_force.first().is_some_and(|worn| worn.table.is_some() && worn.is_posed)
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
        let Some(worn) = self.in_force.first_mut() else { return };
        let Some(table) = worn.table else { return };
        let all = table.taxels().len() as u16;
        let since = worn.renewed.map_or(TURN_US, |renewed| now.since(renewed).min(TURN_US)) as u32;
        let share = (u32::from(all) * since).div_ceil(TURN_US as u32) as u16;
        let count = if whole { all } else { share.clamp(1, all.max(1)) };
        let [_, end] = worn.turn;
        let start = if end >= all { 0 } else { end };
        let turn = [start, start.saturating_add(count).min(all)];
        let is_posed = self.posture.is_fresh(now);
        *worn = InForce { table: Some(table), turn, renewed: Some(now), is_posed };
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

    /// Renews the taxels whose turn it is, and hands over some at a time, in fours, with the levels beyond
    /// which a touch begins there, counts, or goes on where `touched` has all bits of their bytes.
    #[inline(never)]
    pub(crate) fn renew(
        &mut self,
        touched: impl Fn(&[u16; 4]) -> u32,
        mut set: impl FnMut(&[[u16; 4]], &[LevelPairs]),
    ) {
        let Some(InForce { table: Some(table), turn, is_posed, .. }) = self.in_force.first().copied() else {
            return;
        };
        let unit = u32::from(table.unit());
        let mut at = FoldStart::FIRST;
        let (mut felt, mut levels) = ([[0; 2]; AT_ONCE], [[0; 2]; AT_ONCE]);
        for (index, fold) in table.folds().iter().enumerate() {
            let angle = |joint: u8| {
                let joint = self.joints.get(usize::from(joint)).copied().flatten()?;
                self.posture.angle(joint.into())
            };
            let angles = if is_posed { fold.joints.map(angle) } else { [None; 2] };
            let Some(bend) = self.bends.get_mut(index) else { break };
            bend.turn(fold, angles);
            let bend = *bend;
            let corners = self.corners(&table, fold, &bend, &at);
            let mut quads = within(&at, fold, turn);
            while !quads.is_empty() {
                let some = quads.start..quads.end.min(quads.start + AT_ONCE);
                quads.start = some.end;
                let own = some.start - at.quad..some.end - at.quad;
                if bend.is_known {
                    corners.felt(&self.corrections, own, &mut felt);
                } else {
                    let most = table.most(fold, &at).and_then(|most| most.get(own)).unwrap_or(&[]);
                    felt.iter_mut().zip(most).for_each(|(felt, most)| *felt = [0, *most]);
                }
                let taxels = table.taxels().get(some.clone()).unwrap_or(&[]);
                let raised = self.raised.get_mut(some.clone()).unwrap_or_default();
                let before = self.felt.get_mut(some).unwrap_or_default();
                for ((((before, raised), felt), taxels), levels) in
                    before.iter_mut().zip(raised).zip(&felt).zip(taxels).zip(&mut levels)
                {
                    let [was, is] = [*before, *felt].map(|[expected, doubt]| zeros(expected | doubt));
                    *before = *felt;
                    if was != is {
                        hold(&mut self.held, taxels, is);
                    }
                    let [expected, doubt] = *felt;
                    // A touch that is there is in no doubt, unless the posture is unknown.
                    let certain = if bend.is_known { touched(taxels) } else { 0 };
                    *raised = doubt & !certain;
                    *levels = summed(expected, *raised, unit);
                }
                set(taxels, &levels);
            }
            at = at.after(fold);
        }
    }

    /// The knots around a posture.
    fn corners<'a>(
        &self,
        table: &FoldTable<'a>,
        fold: &FoldRecord,
        bend: &Bend,
        start: &FoldStart,
    ) -> Corners<'a> {
        let at = |knot: u16, weight: u16| {
            let knot = usize::from(knot);
            let cells = table.knot(fold, start, knot).unwrap_or(&[]);
            Around { cells, corrections: start.correction + knot * fold.quads(), weight: weight.into() }
        };
        let there = bend.corners.iter().filter(|corner| corner.weight > 0);
        let passes = there.filter_map(|corner| self.passes.get(start.knot + usize::from(corner.knot)));
        let fewest = passes.min().copied().unwrap_or(0);
        Corners {
            around: bend.corners.map(|corner| at(corner.knot, corner.weight)),
            nearest: at(bend.nearest(), SHARES.get(usize::from(fewest)).copied().unwrap_or(WHOLE)),
        }
    }

    /// Hands over each taxel of which something is expected or in doubt, with its expectation, counts.
    pub(crate) fn each(&self, mut take: impl FnMut(usize, u16)) {
        let Some(table) = self.table() else { return };
        for (taxels, [expected, doubt]) in table.taxels().iter().zip(&self.felt) {
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
    pub(crate) fn level(&self, taxel: usize) -> u16 {
        let slot = if self.holds(taxel) { self.slot(taxel as u16) } else { None };
        let of = |slot: usize| {
            let ([expected, _], raised) = (self.felt.get(slot / 4)?, self.raised.get(slot / 4)?);
            let units = [*expected, *raised].map(|bytes| u16::from(byte(bytes, slot % 4)));
            Some(units.iter().sum::<u16>().saturating_mul(self.table()?.unit()))
        };
        slot.and_then(of).unwrap_or(0)
    }

    /// Makes of the values of the taxels that press, counts, what they feel less what is expected of them.
    /// `beyond_levels`: a value is what a taxel feels beyond its level, and that holds the doubt, too.
    /// Otherwise it is all that it feels.
    #[inline(never)] // own registers
    pub(crate) fn subtract(&self, values: &mut [u16], beyond_levels: bool) {
        let Some(table) = self.table() else { return };
        let unit = u32::from(table.unit());
        if beyond_levels {
            let raised = table.taxels().iter().zip(self.raised.iter().copied());
            change(values, raised, unit, u16::saturating_add);
        } else {
            let expected = table.taxels().iter().zip(self.felt.iter().map(|[expected, _]| *expected));
            change(values, expected, unit, u16::saturating_sub);
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
                let expected = self.felt.get(quads.clone()).unwrap_or(&[]);
                let lesson = Lesson::of(table.unit(), *passes);
                for ((taxels, [expected, _]), corrections) in taxels.iter().zip(expected).zip(corrections) {
                    let (told, felt) = felt(taxels);
                    if told != 0 {
                        *corrections = compare(told, &felt, *expected, *corrections, lesson);
                        bend.compared += told.count_ones() as u16;
                    }
                }
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
        let felt = self.felt.get(slot / 4)?;
        Some(felt.map(|bytes| u16::from(byte(bytes, slot % 4)).saturating_mul(table.unit())))
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
            let doubts = self.felt.get(quads.start + first..quads.end).unwrap_or(&[]);
            for (its, [_, doubt]) in its.iter().skip(first).zip(doubts) {
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
        let felt = self.felt.get(..table.taxels().len()).unwrap_or(&self.felt);
        let mut sums = [LaneSums::ZERO; 3];
        for [expected, doubt] in felt {
            let nothing = zeros(expected | doubt) >> 7;
            for (sum, bytes) in sums.iter_mut().zip([nothing, *expected, *doubt]) {
                sum.add(bytes, 1);
            }
        }
        let [nothing, expected, doubt] = sums.map(LaneSums::total);
        let (taxels, unit) = ((4 * felt.len()) as u32 - nothing, u32::from(table.unit()));
        Expected { taxels: taxels as u16, total: expected * unit, doubt: doubt * unit }
    }
}

impl Default for FoldState {
    fn default() -> Self {
        FoldState::new()
    }
}

/// What is left of the doubt of days after so many comparisons, whose mean is nearer to the day's own:
/// `1 / (1 + n)`, of [`WHOLE`].
const SHARES: [u16; MOST_PASSES as usize + 1] = [128, 64, 43, 32, 26, 22, 19, 16];

/// A knot beside the present posture.
struct Around<'a> {
    /// Means, spreads and days of four taxels each.
    cells: &'a [[u32; 3]],
    /// Word of the corrections of its first four taxels.
    corrections: usize,
    /// How much it counts, of [`WHOLE`].
    weight: u32,
}

/// The knots around the present posture.
struct Corners<'a> {
    around: [Around<'a>; 4],
    /// The nearest of them. Its weight is what is left of the doubt of days, where fewest were compared.
    nearest: Around<'a>,
}

impl<'a> Around<'a> {
    /// Cells and corrections of some quads of the fold.
    fn of<'b>(&self, corrections: &'b [u32], quads: &Range<usize>) -> (&'a [[u32; 3]], &'b [u32]) {
        let own = self.corrections + quads.start..self.corrections + quads.end;
        (self.cells.get(quads.clone()).unwrap_or(&[]), corrections.get(own).unwrap_or(&[]))
    }
}

impl Corners<'_> {
    /// Expectations and doubts of some quads of a fold, units.
    #[inline(never)] // own registers
    fn felt(&self, corrections: &[u32], quads: Range<usize>, felt: &mut [[u32; 2]; AT_ONCE]) {
        let mut means = [(LaneSums::NONE, 0); AT_ONCE];
        for corner in self.around.iter().filter(|corner| corner.weight > 0) {
            add_means(&mut means, corner.of(corrections, &quads), corner.weight);
        }
        let (cells, _) = self.nearest.of(corrections, &quads);
        for ((felt, (means, new)), [_, spread, days]) in felt.iter_mut().zip(&means).zip(cells) {
            // The doubt of days is whole where a knot around was not compared yet.
            let whole = days & whole_bytes(*new);
            let mut doubt = LaneSums::ALMOST;
            doubt.add_both([*spread, whole], WHOLE.into());
            doubt.add(days ^ whole, self.nearest.weight);
            *felt = [means.bytes(ZERO), doubt.bytes(0)];
        }
    }
}

/// Adds a knot's part to the expectations of quads, and notes the taxels that were not compared there, by the
/// highest bits of their bytes.
#[inline(never)] // own registers
fn add_means(means: &mut [(LaneSums, u32)], (cells, corrections): (&[[u32; 3]], &[u32]), weight: u32) {
    for (((sums, new), [mean, ..]), correction) in means.iter_mut().zip(cells).zip(corrections) {
        let none = zeros(*correction);
        *new |= none;
        // 128 stands for a correction of 0.
        sums.add_both([*mean, correction | none], weight);
    }
}

/// Changes the values of the taxels that press, four at a time, by their bytes times `unit`, which is at most
/// 128.
#[inline(always)]
fn change<'a>(
    values: &mut [u16],
    quads: impl Iterator<Item = (&'a [u16; 4], u32)>,
    unit: u32,
    by: impl Fn(u16, u16) -> u16 + Copy,
) {
    for (taxels, mut bytes) in quads {
        if bytes == 0 {
            continue;
        }
        for taxel in taxels {
            if let Some(value) = values.get_mut(usize::from(*taxel))
                && *value > 0
            {
                *value = by(*value, ((bytes & 0xFF) * unit) as u16);
            }
            bytes >>= 8;
        }
    }
}

/// Corrections after a comparison of those of four taxels that tell.
#[inline(never)] // own registers
fn compare(mut told: u32, felt: &[u16; 4], mut expected: u32, mut corrections: u32, lesson: Lesson) -> u32 {
    // After four turns each byte is where it was.
    for felt in felt {
        if told & 1 == 1 {
            let to = lesson.corrected(*felt, expected as u8, corrections as u8);
            corrections = corrections & !0xFF | u32::from(to);
        }
        (corrections, expected, told) = (corrections.rotate_right(8), expected >> 8, told >> 1);
    }
    corrections
}

/// The fold's quads within a range of the table's.
fn within(start: &FoldStart, fold: &FoldRecord, [first, end]: [u16; 2]) -> Range<usize> {
    let own = start.quads(fold);
    own.start.max(first.into())..own.end.min(end.into())
}

/// Notes of which of four taxels nothing is expected or in doubt, by the highest bits of `nothing`.
#[inline(never)] // seldom
fn hold(held: &mut [u32], taxels: &[u16; 4], nothing: u32) {
    for (lane, taxel) in taxels.iter().enumerate() {
        let Some(word) = held.get_mut(usize::from(taxel / 32)) else { continue };
        let bit = 1 << (taxel % 32);
        if byte(nothing, lane) == 0 { *word |= bit } else { *word &= !bit }
    }
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
