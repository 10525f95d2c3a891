//! Median 3x3, Sobel, threshold, labels and moments of a panel: by the core, and by imageproc.

use crate::ours::{Ours, Sums};
use crate::scenes::{COLUMNS, ROWS, THRESHOLD};
use image::GrayImage;
use imageproc::contrast::{ThresholdType, threshold};
use imageproc::filter::median_filter;
use imageproc::gradients::sobel_gradients;
use imageproc::region_labelling::{Connectivity, connected_components};
use taxel_core::format::Code;

/// imageproc's functions, and the sums by label in one pass.
pub fn imageproc(image: &GrayImage) -> Vec<Sums> {
    let smooth = median_filter(image, 1, 1);
    std::hint::black_box(sobel_gradients(&smooth));
    let touched = threshold(&smooth, THRESHOLD - 1, ThresholdType::Binary);
    let labels = connected_components(&touched, Connectivity::Eight, image::Luma([0]));
    let mut sums: Vec<Sums> = Vec::new();
    for (x, y, label) in labels.enumerate_pixels() {
        let Some(index) = label.0[0].checked_sub(1) else { continue };
        if sums.len() <= index as usize {
            sums.resize(index as usize + 1, (0, 0, 0));
        }
        let (sum, value) = (&mut sums[index as usize], smooth.get_pixel(x, y).0[0]);
        sum.0 += u64::from(value);
        sum.1 += i64::from(x) * i64::from(value);
        sum.2 += i64::from(y) * i64::from(value);
    }
    sums
}

/// Both in the order of their sums.
pub fn found(scene: &[u8]) -> (Vec<Sums>, Vec<Sums>) {
    let codes: Vec<Code> = scene.iter().map(|value| Code(u16::from(*value))).collect();
    let (mut ours, mut theirs): (Vec<Sums>, _) =
        (Ours::default().segment(&codes).collect(), imageproc(&panel(scene)));
    ours.sort_unstable();
    theirs.sort_unstable();
    (ours, theirs)
}

/// As imageproc takes it.
pub fn panel(scene: &[u8]) -> GrayImage {
    GrayImage::from_raw(COLUMNS as u32, ROWS as u32, scene.to_vec()).unwrap()
}
