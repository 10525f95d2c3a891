//! Touches that were recorded, with groups of them kept apart: what `taxel gestures eval --cross participant` and
//! `taxel intent eval --cross day` print.
//!
//! Reads the folder that TAXEL_DATA names, else `../shared/data` beside the checkout.

use serde_json::Value;
use std::path::{Path, PathBuf};
use taxel::{gestures, intent, touches};

fn data(file: &str) -> PathBuf {
    let named = std::env::var_os("TAXEL_DATA").map(PathBuf::from);
    named.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data")).join(file)
}

fn share(report: &Value, pointer: &str) -> f64 {
    report.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer} in {report}"))
}

#[test]
fn gestures_of_people_who_were_kept_apart() {
    let files = touches::Files { frames: data("haart/train.npz"), labels: Some(data("haart/train.csv")) };
    let report = gestures::across_people(&files).unwrap().json();
    println!("gestures by participant: {report}");
    // Above the 78.6 % of 800 trees, and above what it is compared with.
    assert!(share(&report, "/accuracy") > 0.80);
    assert!(share(&report, "/accuracy") > share(&report, "/beside/knn"));
    assert!(share(&report, "/accuracy") > share(&report, "/beside/map"));
}

#[test]
fn intentions_on_days_that_were_kept_apart() {
    let files = touches::Files {
        frames: data("social_touch/frames.npz"),
        labels: Some(data("social_touch/labels.csv")),
    };
    let report = intent::across_days(&files).unwrap().json();
    println!("intentions by day: {report}");
    assert!(share(&report, "/accuracy") > 0.75 && share(&report, "/recall/attack") > 0.75);
}
