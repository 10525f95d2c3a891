//! What the taxels that fold are expected to feel, and its corrections.

use super::bend::Bend;
use super::lanes::{LaneSums, WHOLE, ZERO, byte, set_byte, summed, whole_bytes, zeros};
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
/// Most days' worth of comparisons at a knot that count: a correction then moves by an eighth.
const MOST_PASSES: u8 = 7;

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

    /// Renews the taxels whose turn it is, all of them if `whole`, and hands over some at a time, in fours,
    /// with the levels beyond which a touch begins there, counts, or goes on where `touched` has all bits of
    /// their bytes.
    #[inline(never)]
    pub(crate) fn renew(
        &mut self,
        now: Micros,
        whole: bool,
        touched: impl Fn(&[u16; 4]) -> u32,
        mut set: impl FnMut(&[[u16; 4]], &[[u16; 4]]),
    ) {
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
        let unit = u32::from(table.unit());
        let mut at = FoldStart::FIRST;
        let (mut felt, mut levels) = ([[0; 2]; AT_ONCE], [[0; 4]; AT_ONCE]);
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
                let before = self.felt.get_mut(some).unwrap_or_default();
                for (((before, felt), taxels), levels) in
                    before.iter_mut().zip(&felt).zip(taxels).zip(&mut levels)
                {
                    let [was, is] = [*before, *felt].map(|[expected, doubt]| zeros(expected | doubt));
                    *before = *felt;
                    if was != is {
                        hold(&mut self.held, taxels, is);
                    }
                    let [expected, doubt] = *felt;
                    // A touch that is there is in no doubt, unless the posture is unknown.
                    let certain = if bend.is_known { touched(taxels) } else { 0 };
                    *levels = summed(expected, doubt & !certain, unit);
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

    /// Subtracts from the taxels that press what is expected of them, counts. `pressure` gives what such a
    /// taxel feels: its value holds only where every taxel begins to press at the same level.
    #[inline(never)] // own registers
    pub(crate) fn subtract(&self, values: &mut [u16], pressure: impl Fn(usize) -> u16) {
        let Some(table) = self.table() else { return };
        let unit = table.unit();
        for (taxels, [expected, doubt]) in table.taxels().iter().zip(&self.felt) {
            if expected | doubt == 0 {
                continue;
            }
            for (lane, taxel) in taxels.iter().enumerate() {
                let taxel = usize::from(*taxel);
                if let Some(value) = values.get_mut(taxel)
                    && *value > 0
                {
                    *value = beyond(&pressure, taxel, expected >> (8 * lane), unit);
                }
            }
        }
    }

    /// True if taxels are to be compared with what is expected of them.
    pub(crate) fn compares(&self) -> bool {
        self.table().is_some() && self.bends.iter().any(|bend| bend.is_known && bend.left > 0)
    }

    /// Compares the taxels whose turn it was and whose joint has come to another knot with what they feel:
    /// `felt` gives the pressure of a taxel without the expectation, counts, or none if it may be touched.
    #[inline(never)]
    pub(crate) fn learn(&mut self, felt: impl Fn(usize) -> Option<u16>) {
        let Some(InForce { table: Some(table), turn, .. }) = self.in_force.first().copied() else { return };
        let unit = u32::from(table.unit()).max(1);
        let mut at = FoldStart::FIRST;
        for (index, fold) in table.folds().iter().enumerate() {
            let Some(bend) = self.bends.get_mut(index) else { break };
            let knot = usize::from(bend.knot.unwrap_or(0));
            let Some(passes) = self.passes.get_mut(at.knot + knot) else { break };
            if bend.is_known && bend.left > 0 {
                for quad in within(&at, fold, turn).take(bend.left.into()) {
                    bend.left -= 1;
                    let correction = at.correction + knot * fold.quads() + quad - at.quad;
                    let (Some(taxels), Some([expected, _]), Some(corrections)) =
                        (table.taxels().get(quad), self.felt.get(quad), self.corrections.get_mut(correction))
                    else {
                        break;
                    };
                    for (lane, taxel) in taxels.iter().enumerate() {
                        let Some(felt) = felt(usize::from(*taxel)) else { continue };
                        let off =
                            ((u32::from(felt) + unit / 2) / unit) as i32 - i32::from(byte(*expected, lane));
                        let (was, passes) = match byte(*corrections, lane) {
                            0 => (ZERO as i32, 0),
                            known => (known.into(), *passes),
                        };
                        set_byte(corrections, lane, (was + nearer(off, passes)).clamp(1, 255) as u8);
                        bend.compared += 1;
                    }
                }
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
        let table = self.table()?;
        let mut start = FoldStart::FIRST;
        let slot = table.folds().iter().find_map(|fold| {
            let here = start;
            start = start.after(fold);
            Some(4 * here.quad + table.place(fold, &here, taxel)?)
        })?;
        let felt = self.felt.get(slot / 4)?;
        Some(felt.map(|bytes| u16::from(byte(bytes, slot % 4)).saturating_mul(table.unit())))
    }

    /// Sum of the doubts of the taxels within a range, counts.
    #[cfg(feature = "folds")]
    pub(crate) fn doubt_within(&self, taxels: &Range<usize>) -> u32 {
        let Some(table) = self.table() else { return 0 };
        let mut at = FoldStart::FIRST;
        let mut sum = 0;
        for fold in table.folds() {
            let quads = at.quads(fold);
            let its = table.taxels().get(quads.clone()).unwrap_or(&[]);
            let first = its.partition_point(|[.., last]| usize::from(*last) < taxels.start);
            let doubts = self.felt.get(quads.start + first..quads.end).unwrap_or(&[]);
            for (its, [_, doubt]) in its.iter().skip(first).zip(doubts) {
                if its.first().is_some_and(|taxel| usize::from(*taxel) >= taxels.end) {
                    break;
                }
                for (lane, taxel) in its.iter().enumerate() {
                    if taxels.contains(&usize::from(*taxel)) {
                        sum += u32::from(byte(*doubt, lane));
                    }
                }
            }
            at = at.after(fold);
        }
        sum * u32::from(table.unit())
    }

    /// Sums over the taxels that `counts` takes.
    pub fn expected(&self, counts: impl Fn(usize) -> bool) -> Expected {
        let mut sum = Expected::default();
        let Some(table) = self.table() else { return sum };
        for (taxels, [expected, doubt]) in table.taxels().iter().zip(&self.felt) {
            for (lane, taxel) in taxels.iter().enumerate() {
                let [expected, doubt] = [*expected, *doubt].map(|bytes| byte(bytes, lane));
                if expected | doubt != 0 && counts(usize::from(*taxel)) {
                    sum.taxels += 1;
                    sum.total += u32::from(expected) * u32::from(table.unit());
                    sum.doubt += u32::from(doubt) * u32::from(table.unit());
                }
            }
        }
        sum
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

/// What a taxel feels less what is expected of it, the lowest byte of `expected`, units.
#[inline(never)] // few taxels of a fold press, and the others need the registers
fn beyond(pressure: impl Fn(usize) -> u16, taxel: usize, expected: u32, unit: u16) -> u16 {
    pressure(taxel).saturating_sub((expected as u8 as u16).saturating_mul(unit))
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

/// Change of a correction that is off by `off`: so that it becomes the mean of the comparisons, as long as
/// these are few.
fn nearer(off: i32, passes: u8) -> i32 {
    if passes == 0 {
        return off;
    }
    let passes = 1 + i32::from(passes);
    (2 * off + if off < 0 { -passes } else { passes }).checked_div(2 * passes).unwrap_or(0)
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

    #[test]
    fn a_correction_becomes_the_mean_of_the_comparisons() {
        for off in -255..=255 {
            assert_eq!(nearer(off, 0), off);
            for passes in 1..=MOST_PASSES {
                let nth = f64::from(1 + passes);
                // Halves away from zero.
                let want = (f64::from(off) / nth).abs() + 0.5;
                assert_eq!(nearer(off, passes), want as i32 * off.signum(), "{off} {passes}");
            }
        }
    }
}
