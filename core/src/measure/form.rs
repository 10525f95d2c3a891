//! The form of a contact: measures that are costly and change slowly.

use super::axis::axis_and_breadth;
use super::component::Component;
use super::contact::Contact;
use super::contour::Contour;
use super::frame_view::FrameView;
use super::quartic::Quartic;

/// Measures the contour, axis and breadth of a contact from its component, number `index`. Returns its ratios
/// of the fourth order, which are not part of the record.
#[inline(never)] // own frame: locals stay within short SP offsets
pub(crate) fn measure_form<const RUNS: usize, const LABELS: usize>(
    frame: &FrameView<'_, RUNS, LABELS>,
    contact: &mut Contact,
    index: u16,
    component: &Component,
) -> Quartic {
    let FrameView { labeller, layout, image } = *frame;
    let Contour { length, slope } = Contour::of(index, component, labeller, layout, image);
    contact.perimeter = length as u16;
    contact.edge = slope.checked_div(length).unwrap_or(0).min(0xffff) as u16;
    let area = layout.areas().get(usize::from(component.bounds.panel));
    let pitch = area.map_or([0, 0], |area| area.pitch_um);
    let (axis, breadth) =
        axis_and_breadth(&component.moments, &component.inverse, component.area.into(), pitch);
    (contact.azimuth, contact.anisotropy) = (axis.azimuth, axis.anisotropy);
    contact.breadth = breadth;
    Quartic::of(index, component, frame)
}
