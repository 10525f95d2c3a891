//! The table of folds: its layout in flash, and its check.
//!
//! | bytes | what |
//! |---|---|
//! | 0 .. 4 | `TXFD` |
//! | 4 .. 8 | CRC-32/ISO-HDLC of all that follows |
//! | 8 | version, 1 |
//! | 9 | number of joints, 1 to 16 |
//! | 10 | number of folds, 1 to 8 |
//! | 11 | 0 |
//! | 12 .. 14 | number of taxels, at most 512 |
//! | 14 .. 16 | number of cells, at most 8,192 |
//! | 16 .. 18 | unit of the cells, counts |
//! | 18 .. 20 | 0 |
//! | 20 .. 24 | sum of the garment's layout, see [`Layout::sum`] |
//! | 24 .. 280 | names of the joints, 16 bytes each, filled with zeros |
//! | 280 .. | a [`FoldRecord`] for each fold |
//! | | numbers of the taxels of each fold, 2 bytes each, ascending; no taxel is in two folds |
//! | | a [`FoldCell`] for each taxel and knot, taxel by taxel |
//!
//! All numbers are little-endian, as the processors are that read them in place.

use super::record::{FoldCell, FoldRecord};
use super::{CELLS, FOLDED, FOLDS, JOINTS, KNOTS};
use crate::format::{Invalid, STORED_NAME, crc32, store_name, stored_name};
use crate::garment::Layout;
use core::ops::Range;

/// First bytes of a table.
const MAGIC: [u8; 4] = *b"TXFD";
/// Version of the layout.
const VERSION: u8 = 1;
/// Position of the CRC.
const CRC: Range<usize> = 4..8;
/// Position of the garment's sum.
const SUM: Range<usize> = 20..24;
/// Position of the names.
const NAMES: Range<usize> = 24..24 + JOINTS * STORED_NAME;

/// Bytes of a table of so many folds, taxels and cells.
pub const fn fold_table_bytes(folds: usize, taxels: usize, cells: usize) -> usize {
    NAMES.end + folds * size_of::<FoldRecord>() + taxels * 2 + cells * size_of::<FoldCell>()
}

/// A checked table, in place.
#[derive(Debug, Clone, Copy)]
pub struct FoldTable<'a> {
    names: &'a [[u8; STORED_NAME]],
    folds: &'a [FoldRecord],
    taxels: &'a [u16],
    cells: &'a [FoldCell],
    unit: u16,
}

/// What a table is made of.
#[derive(Debug, Clone, Copy)]
pub struct FoldTableParts<'a> {
    /// Names of the joints.
    pub joints: &'a [&'a str],
    /// The folds.
    pub folds: &'a [FoldRecord],
    /// Numbers of the taxels of each fold, ascending.
    pub taxels: &'a [u16],
    /// What they feel, taxel by taxel.
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
        let table = FoldTable::view(bytes).ok_or(refuse("must be a table of folds, version 1"))?;
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
        if table.unit == 0 {
            return Err(refuse("must have a unit of at least 1 count"));
        }
        let (mut taxels, mut cells, mut knots) = (table.taxels, 0, 0);
        for fold in table.folds {
            if let Some(must) = fold.fault(table.names.len() as u8) {
                return Err(refuse(must));
            }
            let (its, others) = taxels.split_at_checked(fold.taxels.into()).unwrap_or((&[], &[]));
            if its.is_empty() || its.windows(2).any(|pair| matches!(pair, [a, b] if a >= b)) {
                return Err(refuse("must list the taxels of each fold once, in ascending order"));
            }
            if its.iter().any(|taxel| usize::from(*taxel) >= layout.taxels() || others.contains(taxel)) {
                return Err(refuse("must list taxels of the garment, each in one fold"));
            }
            taxels = others;
            cells += its.len() * fold.cells();
            knots += fold.cells();
        }
        if !taxels.is_empty() || cells != table.cells.len() || knots > KNOTS {
            return Err(refuse("must have as many taxels and cells as its folds, and at most 256 knots"));
        }
        Ok(table)
    }

    /// A table that was checked before, in the same bytes. None if they are no table, or not aligned to two
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
        let (taxels, cells_of) = rest.split_at_checked(taxels * 2)?;
        let cells_of: &[FoldCell] = bytemuck::try_cast_slice(cells_of).ok()?;
        let table = FoldTable {
            names: names.get(..joints)?,
            folds: bytemuck::try_cast_slice(folds).ok()?,
            taxels: bytemuck::try_cast_slice(taxels).ok()?,
            cells: cells_of,
            unit: u16::from_le_bytes([u0, u1]),
        };
        (cells_of.len() == cells).then_some(table)
    }

    /// Name of a joint.
    pub fn joint(&self, joint: u8) -> Option<&'a str> {
        stored_name(self.names.get(usize::from(joint))?)
    }

    /// The folds.
    pub const fn folds(&self) -> &'a [FoldRecord] {
        self.folds
    }

    /// Numbers of the taxels, fold by fold.
    pub const fn taxels(&self) -> &'a [u16] {
        self.taxels
    }

    /// What the taxels feel, taxel by taxel.
    pub const fn cells(&self) -> &'a [FoldCell] {
        self.cells
    }

    /// Unit of the cells, counts.
    pub const fn unit(&self) -> u16 {
        self.unit
    }
}

/// Writes a table, [`fold_table_bytes`] long, for hosts that make one. Error if there is too much of
/// anything, a name is empty or longer than 16 bytes, or the lengths do not fit. [`FoldTable::check`] finds
/// all other mistakes.
pub fn write_fold_table(parts: &FoldTableParts<'_>, layout: &Layout, to: &mut [u8]) -> Result<(), Invalid> {
    let FoldTableParts { joints, folds, taxels, cells, unit } = *parts;
    if !(1..=JOINTS).contains(&joints.len()) || !(1..=FOLDS).contains(&folds.len()) {
        return Err(refuse("must have 1 to 16 joints and 1 to 8 folds"));
    }
    if taxels.len() > FOLDED || cells.len() > CELLS {
        return Err(refuse("must have at most 512 taxels and 8,192 cells"));
    }
    if to.len() != fold_table_bytes(folds.len(), taxels.len(), cells.len()) {
        return Err(refuse("must be as long as its parts"));
    }
    to.fill(0);
    to[..4].copy_from_slice(&MAGIC);
    to[8..11].copy_from_slice(&[VERSION, joints.len() as u8, folds.len() as u8]);
    to[12..14].copy_from_slice(&(taxels.len() as u16).to_le_bytes());
    to[14..16].copy_from_slice(&(cells.len() as u16).to_le_bytes());
    to[16..18].copy_from_slice(&unit.to_le_bytes());
    to[SUM].copy_from_slice(&layout.sum().to_le_bytes());
    let (names, _) = to[NAMES].as_chunks_mut::<STORED_NAME>();
    if !names.iter_mut().zip(joints).all(|(to, joint)| store_name(joint, to)) {
        return Err(refuse("must name its joints in 1 to 16 bytes each"));
    }
    let parts: [&[u8]; 3] =
        [bytemuck::cast_slice(folds), bytemuck::cast_slice(taxels), bytemuck::cast_slice(cells)];
    let mut rest = &mut to[NAMES.end..];
    for part in parts {
        let (place, after) = rest.split_at_mut(part.len());
        place.copy_from_slice(part);
        rest = after;
    }
    let crc = crc32(&to[CRC.end..]);
    to[CRC].copy_from_slice(&crc.to_le_bytes());
    Ok(())
}
