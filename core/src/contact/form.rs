//! The form of a contact: measures that are costly and change slowly.

use super::axis::axis_and_breadth;
use super::component::Component;
use super::contour::Contour;
use super::kurtosis::Kurtosis;
use super::label::Labels;
use super::record::Contact;
use crate::condition::Image;
use crate::garment::Layout;

/// The frame in which forms are measured.
pub(super) struct Sight<'a, const RUNS: usize, const PARTS: usize> {
    pub labels: &'a Labels<RUNS, PARTS>,
    pub layout: &'a Layout,
    pub image: &'a Image<'a>,
}

impl<const RUNS: usize, const PARTS: usize> Sight<'_, RUNS, PARTS> {
    /// Measures the contour, axis and breadth of a contact from its component, number `index`. Returns its
    /// kurtosis, which is not part of the record.
    #[inline(never)] // own frame: locals stay within short SP offsets
    pub fn look(&self, contact: &mut Contact, index: u16, component: &Component) -> Kurtosis {
        let Contour { length, slope } = Contour::of(index, component, self.labels, self.layout, self.image);
        contact.perimeter = length as u16;
        contact.edge = slope.checked_div(length).unwrap_or(0).min(0xffff) as u16;
        let area = self.layout.areas().get(usize::from(component.bounds.panel));
        let pitch = area.map_or([0, 0], |area| area.pitch_um);
        let (axis, breadth) =
            axis_and_breadth(&component.moments, &component.inverse, component.area.into(), pitch);
        (contact.azimuth, contact.anisotropy) = (axis.azimuth, axis.anisotropy);
        contact.breadth = breadth;
        Kurtosis::of(axis.azimuth, index, component, self)
    }
}
