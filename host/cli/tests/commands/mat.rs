//! A mat of one block: a box pressed on it, and its calibration.

use taxel::files::calibrate::{Calibration, Curve, Fitted, Residuals, Rest};
use taxel_core::condition::UNITY;
use taxel_core::garment::{Garment, Layout};

/// A script in which a box of 5 N, with all counts above the floor, lies on the mat for this many seconds.
pub fn box_for(hold_s: u32) -> String {
    format!(
        r#"
duration_s = {}
garment = "block-4x16"
[[touch]]
panel = "mat"
shape = "box"
force_n = 5
at = [7.5, 1.5]
size_mm = 22
start_s = 0.5
rise_s = 0.2
hold_s = {hold_s}
"#,
        hold_s + 1
    )
}

/// A curve with a knee: 1,000 counts for the first newton on a taxel and 500 for each further one.
pub fn knee() -> Calibration {
    let layout = Layout::build(&Garment::block(), 64, 4095).unwrap();
    let fitted = Fitted {
        gains: vec![UNITY; 64],
        curves: vec![Some(Curve::new(vec![[16_000, 1_000_000], [24_000, 2_000_000]]).unwrap())],
        silent: Vec::new(),
        residuals: Residuals { error: 0.0125, worst: 0.03, hysteresis: 0.02, noise: 0.015, rest: 0.0 },
        weights: Vec::new(),
    };
    let rest = Rest { codes: vec![300.0; 64], noise: 2.0 };
    Calibration::of(fitted, &layout, &rest, ["block-4x16", "Anna", "plates of 5 N", "sim"])
}
