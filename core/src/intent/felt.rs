//! Sums over the whole garment in one frame: an embrace, a strap and a blow are more than their strongest
//! contact.

use crate::garment::PANELS;
use core::num::NonZeroU32;

/// Sums over all contacts of a frame.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Felt {
    /// Total pressure, counts.
    pub load: u32,
    /// Touched area, mm2.
    pub cover_mm2: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// Greatest mean pressure of a contact, counts per cm2.
    pub pressure: u32,
    /// Totals of the two greatest contacts, counts.
    greatest: [u32; 2],
    /// By region: pressure of the contacts' parts there, counts, if the caller tells it.
    pub parts: [u32; PANELS],
    /// By region: certain pressure since nothing touched, counts. A taxel may have held up to the least peak
    /// of a contact before anything was announced; only pressure above that is certain.
    pub certain: [u32; PANELS],
}

impl Felt {
    /// Adds a contact of `area` taxels, of `cell_mm2` each, in a region; `least` is the least peak of a
    /// contact there, counts.
    pub fn add(&mut self, region: u8, total: u32, peak: u16, area: u16, cell_mm2: u32, least: u16) {
        let area = u32::from(area);
        self.load = self.load.saturating_add(total);
        self.cover_mm2 = self.cover_mm2.saturating_add(area.saturating_mul(cell_mm2));
        self.peak = self.peak.max(peak);
        self.pressure = self.pressure.max(per_cm2(total, area.saturating_mul(cell_mm2)));
        self.greatest = two_greatest(self.greatest, total);
        if let Some(certain) = self.certain.get_mut(usize::from(region)) {
            // The product has 16 + 16 bits.
            *certain = certain.saturating_add(total.saturating_sub(area * u32::from(least)));
        }
    }

    /// Pressure on the second side: that of the second greatest contact or, if it is more, of the second
    /// region.
    pub(super) fn second(&self) -> u32 {
        let [_, region] = self.parts.iter().fold([0; 2], |two, part| two_greatest(two, *part));
        region.max(self.greatest[1])
    }

    /// Certain pressure on the whole garment, counts.
    pub(super) fn whole(&self) -> u32 {
        self.certain.iter().fold(0, |sum, certain| sum.saturating_add(*certain))
    }
}

/// The two greatest of three values, in descending order; `two` is so.
fn two_greatest([first, second]: [u32; 2], next: u32) -> [u32; 2] {
    [first.max(next), second.max(first.min(next))]
}

/// Counts per cm2 of a total on an area of so many mm2; 0 if the area is not known.
fn per_cm2(total: u32, mm2: u32) -> u32 {
    match NonZeroU32::new(mm2) {
        // The usual case: a contact of less than 42 million counts.
        Some(mm2) if total <= u32::MAX / 100 => 100 * total / mm2,
        Some(mm2) => (total / mm2).saturating_mul(100),
        None => 0,
    }
}
