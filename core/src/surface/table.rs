//! The table of taxels: its layout in flash, and its check.
//!
//! | bytes | what |
//! |---|---|
//! | 0 .. 4 | `TXSF` |
//! | 4 .. 8 | CRC-32/ISO-HDLC of all that follows |
//! | 8 | version, 2 |
//! | 9 | number of links, 1 to 8 |
//! | 10 .. 12 | number of taxels |
//! | 12 .. 16 | sum of the garment's layout, see [`Layout::sum`] |
//! | 16 | number of regions, 0 to 24 |
//! | 17 .. 20 | 0 |
//! | 20 .. 340 | names of the links, 40 bytes each, filled with zeros |
//! | 340 .. 1300 | names of the regions, likewise |
//! | 1300 .. | a [`TaxelRecord`] for each taxel, by number |
//!
//! All numbers are little-endian, as the processors are that read them in place.

use super::taxel::TaxelRecord;
use super::{LINK_NAME, LINKS, REGIONS};
use crate::format::{Invalid, crc32, store_name, stored_name};
use crate::garment::Layout;
use core::ops::Range;

/// First bytes of a table.
const MAGIC: [u8; 4] = *b"TXSF";
/// Version of the layout.
const VERSION: u8 = 2;
/// Position of the CRC.
const CRC: Range<usize> = 4..8;
/// Position of the garment's sum.
const SUM: Range<usize> = 12..16;
/// Position of the number of regions.
const REGION_COUNT: usize = 16;
/// Position of the links' names.
const NAMES: Range<usize> = 20..20 + LINKS * LINK_NAME;
/// Position of the regions' names.
const REGION_NAMES: Range<usize> = NAMES.end..NAMES.end + REGIONS * LINK_NAME;

/// Bytes of a table of so many taxels.
pub const fn table_bytes(taxels: usize) -> usize {
    REGION_NAMES.end + taxels * size_of::<TaxelRecord>()
}

/// A checked table, in place.
#[derive(Debug, Clone, Copy)]
pub struct Table<'a> {
    names: &'a [[u8; LINK_NAME]],
    regions: &'a [[u8; LINK_NAME]],
    taxels: &'a [TaxelRecord],
}

/// Refusal of a table.
const fn refuse(must: &'static str) -> Invalid {
    Invalid { parameter: "surface", must }
}

impl<'a> Table<'a> {
    /// Checks a table for a garment of this layout: its sums, every link, every taxel.
    pub fn check(bytes: &'a [u8], layout: &Layout) -> Result<Table<'a>, Invalid> {
        let table = Table::view(bytes).ok_or(refuse("must be a table of taxels, version 2"))?;
        let (crc, rest) = (bytes.get(CRC).unwrap_or(&[]), bytes.get(CRC.end..).unwrap_or(&[]));
        if crc != crc32(rest).to_le_bytes() {
            return Err(refuse("must arrive undamaged"));
        }
        if table.taxels.len() != layout.taxels() || bytes.get(SUM) != Some(&layout.sum().to_le_bytes()) {
            return Err(refuse("must be made for this garment"));
        }
        if (0..table.names.len()).any(|link| table.link(link as u8).is_none_or(str::is_empty)) {
            return Err(refuse("must name its links"));
        }
        if (0..table.regions.len()).any(|region| table.region(region as u8).is_none_or(str::is_empty)) {
            return Err(refuse("must name its regions"));
        }
        for area in layout.areas() {
            let first = usize::from(area.base);
            let count = usize::from(area.rows) * usize::from(area.columns);
            let taxels = table.taxels.get(first..first + count).unwrap_or(&[]);
            if let Some(must) = taxels.iter().find_map(|taxel| taxel.fault(table.links(), table.regions())) {
                return Err(refuse(must));
            }
            let mut links = taxels.iter().filter(|taxel| taxel.is_placed()).map(|taxel| taxel.link);
            if let Some(first) = links.next()
                && links.any(|link| link != first)
            {
                return Err(refuse("must lay each panel on one link"));
            }
        }
        Ok(table)
    }

    /// A table that was checked before, in the same bytes. None if they are no table, or not aligned to four
    /// bytes. Of other bytes the results are meaningless, but nothing panics.
    pub fn view(bytes: &'a [u8]) -> Option<Table<'a>> {
        let (head, taxels) = bytes.split_at_checked(REGION_NAMES.end)?;
        let [m0, m1, m2, m3, _, _, _, _, version, links, low, high, ..] = *head else { return None };
        let links = usize::from(links);
        if [m0, m1, m2, m3] != MAGIC || version != VERSION || !(1..=LINKS).contains(&links) {
            return None;
        }
        let (names, _) = head.get(NAMES)?.as_chunks();
        let (regions, _) = head.get(REGION_NAMES)?.as_chunks();
        let regions = regions.get(..usize::from(*head.get(REGION_COUNT)?))?;
        let taxels: &[TaxelRecord] = bytemuck::try_cast_slice(taxels).ok()?;
        let table = Table { names: names.get(..links)?, regions, taxels };
        (taxels.len() == usize::from(u16::from_le_bytes([low, high]))).then_some(table)
    }

    /// Number of links.
    pub const fn links(&self) -> usize {
        self.names.len()
    }

    /// Name of a link.
    pub fn link(&self, link: u8) -> Option<&'a str> {
        stored_name(self.names.get(usize::from(link))?)
    }

    /// Index of the link of this name. Cheaper than to compare each [`Table::link`], which must be text.
    pub(super) fn find_link(&self, name: &str) -> Option<usize> {
        let is_its = |stored: &[u8; LINK_NAME]| {
            stored.strip_prefix(name.as_bytes()).is_some_and(|rest| matches!(rest, [] | [0, ..]))
        };
        self.names.iter().position(is_its)
    }

    /// Number of regions.
    pub const fn regions(&self) -> usize {
        self.regions.len()
    }

    /// Name of a region.
    pub fn region(&self, region: u8) -> Option<&'a str> {
        stored_name(self.regions.get(usize::from(region))?)
    }

    /// The taxels, by number.
    pub const fn taxels(&self) -> &'a [TaxelRecord] {
        self.taxels
    }
}

/// Writes a table of these links, regions and taxels, [`table_bytes`] long, for hosts that make one. Error if
/// there is no link, there are too many links or regions, a name is empty or longer than 40 bytes, or the
/// lengths do not fit.
pub fn write_table(
    links: &[&str],
    regions: &[&str],
    taxels: &[TaxelRecord],
    layout: &Layout,
    to: &mut [u8],
) -> Result<(), Invalid> {
    if !(1..=LINKS).contains(&links.len()) {
        return Err(refuse("must have 1 to 8 links"));
    }
    if regions.len() > REGIONS {
        return Err(refuse("must have at most 24 regions"));
    }
    if taxels.len() != layout.taxels() || to.len() != table_bytes(taxels.len()) {
        return Err(refuse("must be made for this garment"));
    }
    let (head, rest) = to.split_at_mut(REGION_NAMES.end);
    head.fill(0);
    head[..4].copy_from_slice(&MAGIC);
    head[8..10].copy_from_slice(&[VERSION, links.len() as u8]);
    head[10..12].copy_from_slice(&(taxels.len() as u16).to_le_bytes());
    head[SUM].copy_from_slice(&layout.sum().to_le_bytes());
    head[REGION_COUNT] = regions.len() as u8;
    for (place, called, must) in [
        (NAMES, links, "must name its links in 1 to 40 bytes each"),
        (REGION_NAMES, regions, "must name its regions in 1 to 40 bytes each"),
    ] {
        let (names, _) = head[place].as_chunks_mut::<LINK_NAME>();
        if !names.iter_mut().zip(called).all(|(to, name)| store_name(name, to)) {
            return Err(refuse(must));
        }
    }
    rest.copy_from_slice(bytemuck::cast_slice(taxels));
    let crc = crc32(&to[CRC.end..]);
    to[CRC].copy_from_slice(&crc.to_le_bytes());
    Ok(())
}
