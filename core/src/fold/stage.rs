//! What the taxels that fold are expected to feel, and its corrections.

use super::bend::{Bend, WHOLE};
use super::posture::PostureState;
use super::record::{FoldCell, FoldRecord};
use super::table::FoldTable;
use super::{CELLS, FOLDED, FOLDS, JOINTS, KNOTS};
use crate::capacity::TAXELS;
use crate::format::Micros;
#[cfg(feature = "folds")]
use crate::format::Name;
use core::ops::Range;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Time in which every taxel that folds is renewed, us.
const TURN_US: u64 = 20_000;
/// 1 if this build has a use for tables, else 0.
const USED: usize = if cfg!(feature = "folds") { 1 } else { 0 };
/// Words of a bit for each taxel.
const WORDS: usize = if cfg!(feature = "folds") { TAXELS.div_ceil(32) } else { 0 };
/// Words of a bit for each cell.
const KNOWN_WORDS: usize = CELLS / 32;
/// Joints of a table.
const KNOWN: usize = if cfg!(feature = "folds") { JOINTS } else { 0 };
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
    /// Corrections of the cells' means, in units of the table.
    corrections: [i8; CELLS],
    /// A bit for each cell that was compared: one that was touched whenever its joint came there was not.
    known: [u32; KNOWN_WORDS],
    /// Comparisons so far at each knot, at most [`MOST_PASSES`].
    passes: [u8; KNOTS],
    /// Expectations and doubts, in units of the table.
    expected: [u8; FOLDED],
    doubt: [u8; FOLDED],
    /// A bit for each taxel of which something is expected, or that is in doubt.
    held: [u32; WORDS],
}

/// A table in force, and whose turn it is.
#[derive(Debug, Clone, Copy)]
struct InForce {
    table: Option<FoldTable<'static>>,
    /// The taxels renewed in the last frame, as numbers in the table's list: from the first to before the
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
            corrections: [0; CELLS],
            known: [0; KNOWN_WORDS],
            passes: [0; KNOTS],
            expected: [0; FOLDED],
            doubt: [0; FOLDED],
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
        self.held.fill(0);
        self.forget();
    }

    /// Forgets all corrections: a new day. The posture stays.
    pub(crate) fn forget(&mut self) {
        if !cfg!(feature = "folds") {
            return;
        }
        self.corrections.fill(0);
        self.known.fill(0);
        self.passes.fill(0);
        self.bends.fill(Bend::NONE);
        self.expected.fill(0);
        self.doubt.fill(0);
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
        self.table().is_some() && taxels.into_iter().any(|taxel| self.holds(taxel))
    }

    /// Renews the taxels whose turn it is, all of them if `whole`, and hands over each with the level beyond
    /// which a touch begins there, and that beyond which one that is there goes on, counts.
    #[inline(never)]
    pub(crate) fn renew(&mut self, now: Micros, whole: bool, mut set: impl FnMut(usize, [u16; 2])) {
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
        let mut at = FoldStart::FIRST;
        for (index, fold) in table.folds().iter().enumerate() {
            let angle = |joint: u8| {
                let joint = self.joints.get(usize::from(joint)).copied().flatten()?;
                self.posture.angle(joint.into())
            };
            let angles = if is_posed { fold.joints.map(angle) } else { [None; 2] };
            let Some(bend) = self.bends.get_mut(index) else { break };
            bend.turn(fold, angles);
            let (bend, cells) = (*bend, fold.cells());
            let corners = self.corners(&bend, &at);
            for slot in at.slots(fold, turn) {
                let first = at.cell + (slot - at.slot) * cells;
                let [expected, doubt] = match bend.is_known {
                    true => self.expectation(table.cells(), &corners, first),
                    false => [0, self.most(&table, first, cells)],
                };
                let (Some(to), Some(doubts)) = (self.expected.get_mut(slot), self.doubt.get_mut(slot)) else {
                    break;
                };
                (*to, *doubts) = (expected, doubt);
                let Some(taxel) = table.taxels().get(slot).copied().map(usize::from) else { break };
                let level = (u16::from(expected) + u16::from(doubt)).saturating_mul(table.unit());
                if let Some(word) = self.held.get_mut(taxel / 32) {
                    let bit = 1 << (taxel % 32);
                    if level > 0 { *word |= bit } else { *word &= !bit }
                }
                let expected =
                    if bend.is_known { u16::from(expected).saturating_mul(table.unit()) } else { level };
                set(taxel, [level, expected]);
            }
            at = at.after(fold);
        }
    }

    /// What the knots around a posture have in common for all taxels of the fold.
    fn corners(&self, bend: &Bend, at: &FoldStart) -> Vec<Around, 4> {
        let mut around = Vec::new();
        for corner in bend.corners.iter().filter(|corner| corner.weight > 0) {
            let passes = self.passes.get(at.knot + usize::from(corner.knot)).copied().unwrap_or(0);
            let left = SHARES.get(usize::from(passes)).copied().unwrap_or(WHOLE);
            // There are as many places as corners.
            let _ = around.push(Around {
                knot: corner.knot.into(),
                weight: corner.weight.into(),
                left: left.into(),
            });
        }
        around
    }

    /// Expectation and doubt of the taxel whose cells begin at `first`, in units.
    #[inline(always)]
    fn expectation(&self, cells: &[FoldCell], corners: &[Around], first: usize) -> [u8; 2] {
        let (mut mean, mut doubt) = (i32::from(WHOLE) / 2, u32::from(WHOLE) * u32::from(WHOLE) / 2);
        for Around { knot, weight, left } in corners {
            let cell = first + knot;
            let (Some(felt), Some(correction)) = (cells.get(cell), self.corrections.get(cell)) else { break };
            let is_known = self.known.get(cell / 32).is_some_and(|word| word >> (cell % 32) & 1 == 1);
            let left = if is_known { *left } else { u32::from(WHOLE) };
            mean += *weight as i32 * (i32::from(felt.mean) + i32::from(*correction));
            doubt += weight * (u32::from(felt.spread) * u32::from(WHOLE) + u32::from(felt.days) * left);
        }
        [(mean >> 8).clamp(0, 255) as u8, (doubt >> 16).min(255) as u8]
    }

    /// The most that a taxel feels at any posture.
    #[inline(never)]
    fn most(&self, table: &FoldTable<'_>, first: usize, cells: usize) -> u8 {
        let felt = table.cells().get(first..first + cells).unwrap_or(&[]);
        let corrections = self.corrections.get(first..first + cells).unwrap_or(&[]);
        let most = felt.iter().zip(corrections).map(|(FoldCell { mean, spread, days }, correction)| {
            let mean = (i32::from(*mean) + i32::from(*correction)).max(0);
            mean + i32::from(*spread) + i32::from(*days)
        });
        most.max().unwrap_or(0).min(255) as u8
    }

    /// Hands over each taxel of which something is expected or in doubt, with its expectation, counts.
    pub(crate) fn each(&self, mut take: impl FnMut(usize, u16)) {
        let Some(table) = self.table() else { return };
        for ((taxel, expected), doubt) in table.taxels().iter().zip(&self.expected).zip(&self.doubt) {
            if *expected | *doubt != 0 {
                take(usize::from(*taxel), u16::from(*expected).saturating_mul(table.unit()));
            }
        }
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
            if bend.is_known && bend.left > 0 {
                for slot in at.slots(fold, turn).take(bend.left.into()) {
                    bend.left -= 1;
                    let (Some(taxel), Some(expected)) = (table.taxels().get(slot), self.expected.get(slot))
                    else {
                        break;
                    };
                    let Some(felt) = felt(usize::from(*taxel)) else { continue };
                    let off = ((u32::from(felt) + unit / 2) / unit) as i32 - i32::from(*expected);
                    let cell = at.cell + (slot - at.slot) * fold.cells() + knot;
                    let passes = passes_of(&self.known, &self.passes, at.knot + knot, cell);
                    if let Some((correction, known)) =
                        self.corrections.get_mut(cell).zip(self.known.get_mut(cell / 32))
                    {
                        let now = i32::from(*correction) + nearer(off, passes);
                        *correction = now.clamp(-127, 127) as i8;
                        *known |= 1 << (cell % 32);
                    }
                    bend.compared += 1;
                }
                // A comparison in which most taxels may have been touched is none.
                if bend.left == 0
                    && bend.compared > fold.taxels / 2
                    && let Some(passes) = self.passes.get_mut(at.knot + knot)
                {
                    *passes = (*passes + 1).min(MOST_PASSES);
                }
            }
            at = at.after(fold);
        }
    }

    /// Expectation of a taxel and its doubt, counts; none if it does not fold.
    pub fn of(&self, taxel: u16) -> Option<[u16; 2]> {
        let table = self.table()?;
        let mut first = 0;
        let slot = table.folds().iter().find_map(|fold| {
            let its = table.taxels().get(first..first + usize::from(fold.taxels))?;
            let slot = its.binary_search(&taxel).ok().map(|at| first + at);
            first += its.len();
            slot
        })?;
        let counts = |units: Option<&u8>| u16::from(units.copied().unwrap_or(0)).saturating_mul(table.unit());
        Some([counts(self.expected.get(slot)), counts(self.doubt.get(slot))])
    }

    /// Sums over the taxels that `counts` takes.
    pub fn expected(&self, counts: impl Fn(usize) -> bool) -> Expected {
        let mut sum = Expected::default();
        let Some(table) = self.table() else { return sum };
        for ((taxel, expected), doubt) in table.taxels().iter().zip(&self.expected).zip(&self.doubt) {
            if *expected | *doubt != 0 && counts(usize::from(*taxel)) {
                sum.taxels += 1;
                sum.total += u32::from(*expected) * u32::from(table.unit());
                sum.doubt += u32::from(*doubt) * u32::from(table.unit());
            }
        }
        sum
    }
}

/// Comparisons so far of a cell at its knot.
fn passes_of(known: &[u32], passes: &[u8], knot: usize, cell: usize) -> u8 {
    let is_known = known.get(cell / 32).is_some_and(|word| word >> (cell % 32) & 1 == 1);
    if is_known { passes.get(knot).copied().unwrap_or(0) } else { 0 }
}

impl Default for FoldState {
    fn default() -> Self {
        FoldState::new()
    }
}

/// What is left of the doubt of days after so many comparisons, whose mean is nearer to the day's own:
/// `1 / (1 + n)`, of [`WHOLE`].
const SHARES: [u16; MOST_PASSES as usize + 1] = [256, 128, 86, 64, 52, 43, 37, 32];

/// A knot beside the present posture.
struct Around {
    knot: usize,
    /// How much it counts, of [`WHOLE`].
    weight: u32,
    /// What is left of the doubt of days there, of [`WHOLE`].
    left: u32,
}

/// Change of a correction that is off by `off`: so that it becomes the mean of the comparisons, as long as
/// these are few.
fn nearer(off: i32, passes: u8) -> i32 {
    let passes = 1 + i32::from(passes);
    (2 * off + if off < 0 { -passes } else { passes }).checked_div(2 * passes).unwrap_or(0)
}

/// Where the entries of a fold begin.
#[derive(Clone, Copy)]
struct FoldStart {
    slot: usize,
    cell: usize,
    knot: usize,
}

impl FoldStart {
    const FIRST: FoldStart = FoldStart { slot: 0, cell: 0, knot: 0 };

    /// The fold's taxels within a range of the table's list.
    fn slots(&self, fold: &FoldRecord, [first, end]: [u16; 2]) -> Range<usize> {
        let last = self.slot + usize::from(fold.taxels);
        usize::from(first).max(self.slot)..usize::from(end).min(last)
    }

    /// The place of the fold after this one.
    fn after(&self, fold: &FoldRecord) -> FoldStart {
        let taxels = usize::from(fold.taxels);
        FoldStart {
            slot: self.slot + taxels,
            cell: self.cell + taxels * fold.cells(),
            knot: self.knot + fold.cells(),
        }
    }
}
