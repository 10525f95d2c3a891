//! Where nothing tells drift from touch the board says so, and means nothing.

use super::rig::{Trial, feel};
use taxel::sim::Course;
use taxel_core::garment::Garment;

#[test]
fn drift_beyond_what_is_followed_is_told_as_unsure() {
    let common = Course { rate: 60.0, way: 1_200.0 };
    let felt = feel(&Trial { common, ..Trial::new(Garment::block(), 100.0) }, 20.0);
    assert!(felt.unsure_s > 10.0, "{} s", felt.unsure_s);
}

#[test]
fn a_panel_that_is_covered_while_it_drifts_is_unsure_after_some_time() {
    let common = Course { rate: 10.0, way: 1_200.0 };
    let trial = Trial { common, ..Trial::new(Garment::recorded(4, 16), 100.0) };
    let plate = trial
        .touched("palm", 40.0, 20.0, 0.3, 60.0)
        .touches
        .replace("force_n = 40", "size_mm = [220, 90]\nforce_n = 40");
    let felt = feel(&Trial { touches: plate, common, ..Trial::new(Garment::recorded(4, 16), 100.0) }, 80.0);
    assert!(felt.unsure_s > 5.0, "{} s", felt.unsure_s);
}
