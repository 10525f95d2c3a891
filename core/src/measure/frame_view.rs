//! Input of the measurement of forms.

use crate::garment::Layout;
use crate::image::view::Image;
use crate::segment::labeller::Labeller;

/// The frame in which forms are measured.
pub(crate) struct FrameView<'a, const RUNS: usize, const LABELS: usize> {
    pub labeller: &'a Labeller<RUNS, LABELS>,
    pub layout: &'a Layout,
    pub image: &'a Image<'a>,
}
