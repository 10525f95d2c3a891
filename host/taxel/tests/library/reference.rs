//! The reference images: exact moments, and the features that follow from them.

use serde_json::Value;
use std::path::Path;
use taxel::moments::Features;

/// All cases.
pub fn cases() -> Vec<Value> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    serde_json::from_slice(&std::fs::read(root.join("tests/reference/moments.json")).unwrap()).unwrap()
}

fn float(value: &Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64().unwrap(), |text| text.parse().unwrap())
}

fn close(have: &Value, want: f64, bound: f64, what: &str) {
    let have = have.as_f64().unwrap();
    assert!((have - want).abs() <= bound, "{what}: {have}, expected {want}");
}

/// Checks the features of a case's image: integers exactly, the rest within the bounds that the core documents.
pub fn check(image: &[u16], case: &Value) {
    let columns = case["shape"][1].as_u64().unwrap() as usize;
    let have = serde_json::to_value(Features::of(image, columns).unwrap()).unwrap();
    let (exact, reference) = (&case["exact"], &case["f64"]);
    for key in ["m", "sx", "sy", "sxx", "syy", "sxy", "Jm"] {
        assert_eq!(have[key], exact[key], "{key}");
    }
    for key in ["area", "peak"] {
        assert_eq!(have[key].as_f64(), reference[key].as_f64(), "{key}");
    }
    let nmi = float(&exact["nmi"]);
    for (key, want) in [
        ("nmi", nmi),
        ("nmi_peak", nmi * float(&reference["peak"]).sqrt()),
        ("nmi_s2", float(&reference["nmi_s2"])),
    ] {
        close(&have[key], want, 2f64.powi(-25) + 4.001e-9 * want, key);
    }
    close(&have["column"], float(&reference["cx"]), 1e-12, "column");
    close(&have["row"], float(&reference["cy"]), 1e-12, "row");
    // ecc^2 = 1 - minor / major, D / J = (major - minor) / (major + minor)
    let square = float(&exact["ecc"]).powi(2);
    close(&have["anisotropy"], square / (2.0 - square), 1.0 / 65536.0 + 1e-8, "anisotropy");
    // None exactly where D / J < clamp(1 / area, 0.02, 0.15).
    let limit = (1.0 / float(&reference["area"])).clamp(0.02, 0.15);
    match have["azimuth_rad"].as_f64() {
        None => assert!(square / (2.0 - square) < limit + 1e-4, "no azimuth"),
        Some(azimuth) => {
            assert!(square / (2.0 - square) > limit - 1e-4, "an azimuth");
            let turn = (azimuth - float(&exact["theta"])).rem_euclid(std::f64::consts::PI);
            assert!(turn.min(std::f64::consts::PI - turn) <= 1.3e-6, "azimuth");
        }
    }
}
