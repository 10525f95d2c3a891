//! Sums over the whole garment in one frame: an embrace, a strap and a blow are more than their strongest
//! contact.

use crate::garment::PANELS;

/// Sums over all contacts of a frame.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Felt {
    /// Total pressure, counts.
    pub load: u32,
    /// Touched area, mm2.
    pub cover_mm2: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
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
        if let Some(certain) = self.certain.get_mut(usize::from(region)) {
            // The product has 16 + 16 bits.
            *certain = certain.saturating_add(total.saturating_sub(area * u32::from(least)));
        }
    }

    /// Certain pressure on the whole garment, counts.
    pub(super) fn whole(&self) -> u32 {
        self.certain.iter().fold(0, |sum, certain| sum.saturating_add(*certain))
    }
}
