//! The table of folds: its layout in flash, and its check.
//!
//! | bytes | what |
//! |---|---|
//! | 0 .. 4 | `TXFD` |
//! | 4 .. 8 | CRC-32/ISO-HDLC of all that follows |
//! | 8 | version, 2 |
//! | 9 | number of joints, 1 to 16 |
//! | 10 | number of folds, 1 to 8 |
//! | 11 | 0 |
//! | 12 .. 14 | number of taxels, each fold's filled up to a multiple of four, at most 512 |
//! | 14 .. 16 | number of their cells, at most 8,192 |
//! | 16 .. 18 | unit of the cells, counts |
//! | 18 .. 20 | 0 |
//! | 20 .. 24 | sum of the garment's layout, see [`Layout::sum`] |
//! | 24 .. 280 | names of the joints, 16 bytes each, filled with zeros |
//! | 280 .. | a [`FoldRecord`] for each fold |
//! | | taxels of each fold, 2 bytes each, ascending, filled up with [`NO_TAXEL`]; none is in two folds |
//! | | for each fold: its cells, knot by knot, then the most that each of its taxels may feel at any knot |
//!
//! The cells of a knot are 12 bytes for each four taxels: their means, their spreads, their days (see
//! [`FoldCell`]); the most is the greatest sum of the three, at most 255. What is filled up holds zeros.
//!
//! All numbers are little-endian, as the processors are that read them in place.

use super::lanes::byte;
use super::record::{FoldCell, FoldRecord, NO_TAXEL};
use super::{CELLS, FOLDED, FOLDS, JOINTS, KNOTS};
use crate::format::{Invalid, STORED_NAME, crc32, store_name, stored_name};
use crate::garment::Layout;
use core::ops::Range;

/// First bytes of a table.
const MAGIC: [u8; 4] = *b"TXFD";
/// Version of the layout.
const VERSION: u8 = 2;
/// Position of the CRC.
const CRC: Range<usize> = 4..8;
/// Position of the garment's sum.
const SUM: Range<usize> = 20..24;
/// Position of the names.
const NAMES: Range<usize> = 24..24 + JOINTS * STORED_NAME;

/// Bytes of a table of so many folds, taxels and cells; each fold's taxels are filled up to a multiple of four.
pub const fn fold_table_bytes(folds: usize, taxels: usize, cells: usize) -> usize {
    NAMES.end + folds * size_of::<FoldRecord>() + taxels * 3 + cells * WORDS
}

/// Largest unit, counts: the sum of an expectation and its doubt then fits in 16 bits.
pub const MOST_UNIT: u16 = 128;
/// Words of four cells: means, spreads, days.
const WORDS: usize = 3;

/// A checked table, in place.
#[derive(Debug, Clone, Copy)]
pub struct FoldTable<'a> {
    names: &'a [[u8; STORED_NAME]],
    folds: &'a [FoldRecord],
    taxels: &'a [[u16; 4]],
    words: &'a [u32],
    unit: u16,
}

/// Parts of a table.
#[derive(Debug, Clone, Copy)]
pub struct FoldTableParts<'a> {
    /// Names of the joints.
    pub joints: &'a [&'a str],
    /// The folds.
    pub folds: &'a [FoldRecord],
    /// Numbers of the taxels of each fold, ascending.
    pub taxels: &'a [u16],
    /// Pressure on the taxels at each knot, taxel by taxel.
    pub cells: &'a [FoldCell],
    /// Unit of the cells, counts.
    pub unit: u16,
}

/// Refusal of a table.
const fn refuse(must: &'static str) -> Invalid {
    Invalid { parameter: "folds", must }
}

impl<'a> FoldTable<'a> {
    /// Checks a table for a garment of this layout.
    pub fn check(bytes: &'a [u8], layout: &Layout) -> Result<FoldTable<'a>, Invalid> {
        let table = FoldTable::view(bytes).ok_or(refuse("must be a table of folds, version 2"))?;
        let (crc, rest) = (bytes.get(CRC).unwrap_or(&[]), bytes.get(CRC.end..).unwrap_or(&[]));
        if crc != crc32(rest).to_le_bytes() {
            return Err(refuse("must arrive undamaged"));
        }
        if bytes.get(SUM) != Some(&layout.sum().to_le_bytes()) {
            return Err(refuse("must be made for this garment"));
        }
        if table.names.iter().any(|name| stored_name(name).is_none_or(str::is_empty)) {
            return Err(refuse("must name its joints"));
        }
        if !(1..=MOST_UNIT).contains(&table.unit) {
            return Err(refuse("must have a unit of 1 to 128 counts"));
        }
        let mut start = FoldStart::FIRST;
        for fold in table.folds {
            if let Some(must) = fold.fault(table.names.len() as u8) {
                return Err(refuse(must));
            }
            let rest = table.taxels.get(start.quad..).unwrap_or(&[]).as_flattened();
            let (its, others) = rest.split_at_checked(fold.quads() * 4).unwrap_or((&[], &[]));
            let (its, fill) = its.split_at_checked(fold.taxels.into()).unwrap_or((&[], &[]));
            if its.is_empty() || its.windows(2).any(|pair| matches!(pair, [a, b] if a >= b)) {
                return Err(refuse("must list the taxels of each fold once, in ascending order"));
            }
            if its.iter().any(|taxel| usize::from(*taxel) >= layout.taxels() || others.contains(taxel)) {
                return Err(refuse("must list taxels of the garment, each in one fold"));
            }
            if fill.iter().any(|taxel| *taxel != NO_TAXEL) {
                return Err(refuse(
                    "must fill the list of a fold's taxels up to a multiple of four with 65535",
                ));
            }
            start = start.after(fold);
        }
        if start.quad != table.taxels.len() || start.word != table.words.len() || start.knot > KNOTS {
            return Err(refuse("must have as many taxels and cells as its folds, and at most 256 knots"));
        }
        if !table.states_the_most() {
            return Err(refuse("must state the most that each taxel may feel"));
        }
        Ok(table)
    }

    /// True if the most that each taxel may feel is what it must be.
    fn states_the_most(&self) -> bool {
        let mut start = FoldStart::FIRST;
        self.folds.iter().all(|fold| {
            let here = start;
            start = start.after(fold);
            (0..usize::from(fold.taxels)).all(|at| {
                let cells = (0..fold.cells()).filter_map(|knot| self.cell_of(fold, &here, at, knot));
                let stated =
                    self.most(fold, &here).and_then(|row| row.get(at / 4)).map(|word| byte(*word, at % 4));
                stated == Some(most_of(cells))
            })
        })
    }

    /// A table that was checked before, in the same bytes. None if they are no table, or not aligned to four
    /// bytes. Of other bytes the results are meaningless, but nothing panics.
    pub fn view(bytes: &'a [u8]) -> Option<FoldTable<'a>> {
        let (head, rest) = bytes.split_at_checked(NAMES.end)?;
        let [m0, m1, m2, m3, _, _, _, _, version, joints, folds, _, t0, t1, c0, c1, u0, u1, ..] = *head
        else {
            return None;
        };
        let (joints, folds) = (usize::from(joints), usize::from(folds));
        let [taxels, cells] = [[t0, t1], [c0, c1]].map(|count| usize::from(u16::from_le_bytes(count)));
        let fits = (1..=JOINTS).contains(&joints) && (1..=FOLDS).contains(&folds);
        if [m0, m1, m2, m3] != MAGIC || version != VERSION || !fits || taxels > FOLDED || cells > CELLS {
            return None;
        }
        let (names, _) = head.get(NAMES)?.as_chunks();
        let (folds, rest) = rest.split_at_checked(folds * size_of::<FoldRecord>())?;
        let (listed, words) = rest.split_at_checked(taxels * 2)?;
        let words: &[u32] = bytemuck::try_cast_slice(words).ok()?;
        let table = FoldTable {
            names: names.get(..joints)?,
            folds: bytemuck::try_cast_slice(folds).ok()?,
            taxels: bytemuck::try_cast_slice(listed).ok()?,
            words,
            unit: u16::from_le_bytes([u0, u1]),
        };
        (words.len() * 4 == cells * WORDS + taxels).then_some(table)
    }

    /// Name of a joint.
    pub fn joint(&self, joint: u8) -> Option<&'a str> {
        stored_name(self.names.get(usize::from(joint))?)
    }

    /// The folds.
    pub const fn folds(&self) -> &'a [FoldRecord] {
        self.folds
    }

    /// Numbers of the taxels, fold by fold, four to a word of what they feel.
    pub const fn taxels(&self) -> &'a [[u16; 4]] {
        self.taxels
    }

    /// The folds, each with the numbers of its taxels.
    pub fn folded(self) -> impl Iterator<Item = (&'a FoldRecord, &'a [u16])> {
        let (mut start, taxels) = (FoldStart::FIRST, self.taxels);
        self.folds.iter().map(move |fold| {
            let its = taxels.get(start.quads(fold)).unwrap_or(&[]).as_flattened();
            start = start.after(fold);
            (fold, its.get(..fold.taxels.into()).unwrap_or(its))
        })
    }

    /// Returns the pressure on a taxel at a knot of its fold. None if it does not fold, or has no such knot.
    pub fn cell(&self, taxel: u16, knot: usize) -> Option<FoldCell> {
        let mut start = FoldStart::FIRST;
        self.folds.iter().find_map(|fold| {
            let here = start;
            start = start.after(fold);
            self.cell_of(fold, &here, self.place(fold, &here, taxel)?, knot)
        })
    }

    /// Place of a taxel among those of a fold.
    pub(super) fn place(&self, fold: &FoldRecord, start: &FoldStart, taxel: u16) -> Option<usize> {
        let its = self.taxels.get(start.quads(fold))?.as_flattened();
        its.get(..fold.taxels.into())?.binary_search(&taxel).ok()
    }

    /// Cell of a fold's taxel number `at`.
    fn cell_of(&self, fold: &FoldRecord, start: &FoldStart, at: usize, knot: usize) -> Option<FoldCell> {
        let [mean, spread, days] = self.knot(fold, start, knot)?.get(at / 4)?.map(|word| byte(word, at % 4));
        Some(FoldCell { mean, spread, days })
    }

    /// Cells of a fold at one of its knots, four taxels after the other: means, spreads, days.
    pub(super) fn knot(
        &self,
        fold: &FoldRecord,
        start: &FoldStart,
        knot: usize,
    ) -> Option<&'a [[u32; WORDS]]> {
        let cells = self.words.get(start.word..)?.get(..fold.quads() * fold.cells() * WORDS)?;
        let (cells, _) = cells.as_chunks();
        cells.get(knot * fold.quads()..)?.get(..fold.quads())
    }

    /// The most that the taxels of a fold may feel.
    pub(super) fn most(&self, fold: &FoldRecord, start: &FoldStart) -> Option<&'a [u32]> {
        self.words.get(start.word + fold.cells() * WORDS * fold.quads()..)?.get(..fold.quads())
    }

    /// Unit of the cells, counts.
    pub const fn unit(&self) -> u16 {
        self.unit
    }
}

/// The most that a taxel of these cells may feel.
fn most_of(cells: impl Iterator<Item = FoldCell>) -> u8 {
    cells
        .map(|FoldCell { mean, spread, days }| mean.saturating_add(spread).saturating_add(days))
        .max()
        .unwrap_or(0)
}

/// Start of the entries of a fold.
#[derive(Clone, Copy)]
pub(super) struct FoldStart {
    /// Number of its first four taxels.
    pub quad: usize,
    /// Word of its first cells.
    word: usize,
    /// Word of the corrections of its first knot.
    pub correction: usize,
    /// Number of its first knot.
    pub knot: usize,
}

impl FoldStart {
    pub const FIRST: FoldStart = FoldStart { quad: 0, word: 0, correction: 0, knot: 0 };

    /// The fold's quads.
    pub fn quads(&self, fold: &FoldRecord) -> Range<usize> {
        self.quad..self.quad + fold.quads()
    }

    /// The place of the fold after this one.
    pub fn after(&self, fold: &FoldRecord) -> FoldStart {
        let (quads, cells) = (fold.quads(), fold.cells());
        FoldStart {
            quad: self.quad + quads,
            word: self.word + quads * (cells * WORDS + 1),
            correction: self.correction + quads * cells,
            knot: self.knot + cells,
        }
    }
}

/// Bytes of a table of these folds.
pub fn fold_table_length(folds: &[FoldRecord]) -> usize {
    let quads: usize = folds.iter().map(FoldRecord::quads).sum();
    let cells: usize = folds.iter().map(|fold| fold.quads() * fold.cells()).sum();
    fold_table_bytes(folds.len(), 4 * quads, 4 * cells)
}

/// Writes a table, [`fold_table_length`] long, for hosts that make one. Error if there is too much of
/// anything, a name is empty or longer than 16 bytes, or the lengths do not fit. [`FoldTable::check`] finds
/// all other mistakes.
pub fn write_fold_table(parts: &FoldTableParts<'_>, layout: &Layout, to: &mut [u8]) -> Result<(), Invalid> {
    let FoldTableParts { joints, folds, taxels, cells, unit } = *parts;
    if !(1..=JOINTS).contains(&joints.len()) || !(1..=FOLDS).contains(&folds.len()) {
        return Err(refuse("must have 1 to 16 joints and 1 to 8 folds"));
    }
    let listed: usize = folds.iter().map(|fold| usize::from(fold.taxels)).sum();
    let felt: usize = folds.iter().map(|fold| usize::from(fold.taxels) * fold.cells()).sum();
    if to.len() != fold_table_length(folds) || listed != taxels.len() || felt != cells.len() {
        return Err(refuse("must be as long as its parts"));
    }
    let quads: usize = folds.iter().map(FoldRecord::quads).sum();
    let filled: usize = folds.iter().map(|fold| fold.quads() * fold.cells()).sum();
    if quads * 4 > FOLDED || filled * 4 > CELLS {
        return Err(refuse("must have at most 512 taxels and 8,192 cells"));
    }
    to.fill(0);
    to[..4].copy_from_slice(&MAGIC);
    to[8..11].copy_from_slice(&[VERSION, joints.len() as u8, folds.len() as u8]);
    to[12..14].copy_from_slice(&(4 * quads as u16).to_le_bytes());
    to[14..16].copy_from_slice(&(4 * filled as u16).to_le_bytes());
    to[16..18].copy_from_slice(&unit.to_le_bytes());
    to[SUM].copy_from_slice(&layout.sum().to_le_bytes());
    let (names, _) = to[NAMES].as_chunks_mut::<STORED_NAME>();
    if !names.iter_mut().zip(joints).all(|(to, joint)| store_name(joint, to)) {
        return Err(refuse("must name its joints in 1 to 16 bytes each"));
    }
    let records: &[u8] = bytemuck::cast_slice(folds);
    let (place, rest) = to[NAMES.end..].split_at_mut(records.len());
    place.copy_from_slice(records);
    let (mut lists, mut words) = rest.split_at_mut(quads * 8);
    let (mut taxels, mut cells) = (taxels, cells);
    for fold in folds {
        let (count, width) = (usize::from(fold.taxels), fold.quads() * 4);
        let list = lists.split_off_mut(..2 * width).unwrap_or_default();
        let own = words.split_off_mut(..width * (fold.cells() * WORDS + 1)).unwrap_or_default();
        list.fill(NO_TAXEL as u8);
        for at in 0..count {
            list[2 * at..][..2].copy_from_slice(&taxels[at].to_le_bytes());
            let its = &cells[at * fold.cells()..][..fold.cells()];
            for (knot, cell) in its.iter().enumerate() {
                for (word, byte) in [cell.mean, cell.spread, cell.days].into_iter().enumerate() {
                    own[knot * WORDS * width + (at / 4 * WORDS + word) * 4 + at % 4] = byte;
                }
            }
            own[fold.cells() * WORDS * width + at] = most_of(its.iter().copied());
        }
        (taxels, cells) = (&taxels[count..], &cells[count * fold.cells()..]);
    }
    let crc = crc32(&to[CRC.end..]);
    to[CRC].copy_from_slice(&crc.to_le_bytes());
    Ok(())
}
