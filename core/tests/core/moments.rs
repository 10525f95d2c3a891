//! Moments, NMI and axes against the reference file `reference/moments.json` (25 digits), and on drawn
//! touches. Their bounds are asserted by the test target `bounds`.

use serde_json::Value;
use taxel_core::contact::{Axis, Moments, axis, breadth};
use taxel_core::garment::Transform;
use taxel_core::shape::nmi;

struct Case {
    name: String,
    /// From the image where the file holds it, else (32 x 64) from the reference's own sums.
    moments: Moments,
    image: Option<Vec<u16>>,
    peak: u16,
    exact: Value,
    float: Value,
}

fn cases() -> Vec<Case> {
    let list: Vec<Value> =
        serde_json::from_str(include_str!("../../../tests/reference/moments.json")).unwrap();
    let number = |v: &Value| v.as_u64().unwrap();
    let case = |case: &Value| {
        let image = case["img"].as_array();
        let image: Option<Vec<u16>> = image.map(|list| list.iter().map(|v| number(v) as u16).collect());
        let is = |name: &str| case["exact"][name].as_i64().unwrap();
        let moments = match &image {
            Some(image) => Moments::of_image(image, number(&case["shape"][1]) as usize),
            None => Moments {
                m: is("m") as u64,
                sx: is("sx"),
                sy: is("sy"),
                sxx: is("sxx") as u64,
                syy: is("syy") as u64,
                sxy: is("sxy"),
                s2: 0,
            },
        };
        Case {
            name: format!("{} {}", case["set"], case["cls"]),
            moments,
            image,
            peak: case["f64"]["peak"].as_f64().unwrap() as u16,
            exact: case["exact"].clone(),
            float: case["f64"].clone(),
        }
    };
    list.iter().map(case).collect()
}

fn float(value: &Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64().unwrap(), |text| text.parse().unwrap())
}

/// Difference of two axes: modulo half a turn.
fn axis_error(a: f64, b: f64) -> f64 {
    let pi = std::f64::consts::PI;
    let d = (a - b).rem_euclid(pi);
    d.min(pi - d)
}

#[test]
fn every_integer_is_exact() {
    for case in cases() {
        let moments = case.moments;
        let central = moments.central();
        let is = |name: &str| case.exact[name].as_i64().unwrap();
        let have = [moments.m as i64, moments.sx, moments.sy, moments.sxx as i64, moments.syy as i64];
        assert_eq!(have, ["m", "sx", "sy", "sxx", "syy"].map(is), "{}", case.name);
        assert_eq!([moments.sxy, moments.jm() as i64], ["sxy", "Jm"].map(is), "{}", case.name);
        let have = [central.a as i64, central.b as i64, central.c];
        assert_eq!(have, ["mu20_m", "mu02_m", "mu11_m"].map(is), "{}", case.name);
        if let Some(image) = &case.image {
            let squares: u64 = image.iter().map(|f| u64::from(*f).pow(2)).sum();
            assert_eq!(moments.s2, squares, "{}", case.name);
            assert_eq!(image.iter().max(), Some(&case.peak), "{}", case.name);
        }
    }
}

#[test]
fn nmi_is_within_its_bound() {
    let mut worst = 0f64;
    for case in cases() {
        let moments = case.moments;
        let peak = case.peak;
        let have = nmi(&moments, peak);
        let mut check = |have: f64, want: f64, reference: f64| {
            let error = (have - want).abs();
            assert!(error <= 2f64.powi(-25) + (4e-9 + reference) * want, "{} {have} {want}", case.name);
            worst = worst.max(error);
        };
        check(have.published.to_f64(), float(&case.exact["nmi"]), 0.0);
        check(have.peak.to_f64(), float(&case.exact["nmi"]) * f64::from(peak).sqrt(), 1e-15);
        if case.image.is_some() {
            check(have.s2.to_f64(), float(&case.float["nmi_s2"]), 1e-12);
        }
        let m = moments.m as f64;
        let sheppard = (moments.jm() as f64 - m * m / 6.0).sqrt() / m.powf(1.5);
        check(have.peak_sheppard.to_f64(), sheppard * f64::from(peak).sqrt(), 1e-12);
        check(have.s2_sheppard.to_f64(), sheppard * (moments.s2 as f64 / m).sqrt(), 1e-12);
    }
    println!("NMI, largest error {worst:.2e}");
}

#[test]
fn axes_are_within_their_bounds() {
    let (mut worst, mut worst_ratio) = (0f64, 0f64);
    for case in cases() {
        let moments = case.moments;
        let Axis { azimuth, anisotropy } = axis(&moments.central(), 1000);
        let ecc = float(&case.exact["ecc"]);
        // ecc^2 = 1 - minor / major, D / J = (major - minor) / (major + minor)
        let ratio = ecc * ecc / (2.0 - ecc * ecc);
        worst_ratio = worst_ratio.max((anisotropy.to_f64() - ratio).abs());
        match azimuth {
            Some(azimuth) => {
                worst = worst.max(axis_error(azimuth.to_radians(), float(&case.exact["theta"])));
            }
            None => assert!(ratio < 0.02, "{}", case.name),
        }
    }
    println!("azimuth, largest error {worst:.2e} rad; anisotropy {worst_ratio:.2e}");
    assert!(worst <= 1.3e-6);
    assert!(worst_ratio <= 1.0 / 65536.0 + 1e-8);
}

/// Fills what `inside` says on a panel of 64 x 64.
fn drawn(inside: impl Fn(f64, f64) -> bool) -> (Moments, u32) {
    let image: Vec<u16> =
        (0..4096).map(|i| if inside((i % 64) as f64, (i / 64) as f64) { 1000 } else { 0 }).collect();
    let area = image.iter().filter(|v| **v > 0).count();
    (Moments::of_image(&image, 64), area as u32)
}

#[test]
fn directions_have_the_right_sign() {
    let turn = |inside: fn(f64, f64) -> bool| {
        let (moments, area) = drawn(inside);
        axis(&moments.central(), area).azimuth.map(|a| a.to_radians().to_degrees().round() as i32)
    };
    assert_eq!(turn(|_, y| y == 20.0), Some(0));
    assert_eq!(turn(|x, _| x == 20.0), Some(90));
    assert_eq!(turn(|x, y| x == y), Some(45));
    assert_eq!(turn(|x, y| x + y == 63.0), Some(-45));
    assert_eq!(turn(|x, y| x < 30.0 && y < 30.0), None);
    assert_eq!(turn(|x, y| x == 7.0 && y == 9.0), None);
    assert_eq!(turn(|_, _| false), None);
}

#[test]
fn breadth_is_that_of_a_strip() {
    // A strip of 5 x 40 along x or y, at pitches that differ.
    let along_x = drawn(|x, y| x < 40.0 && (10.0..15.0).contains(&y)).0;
    let along_y = drawn(|x, y| y < 40.0 && (10.0..15.0).contains(&x)).0;
    assert_eq!(breadth(&along_x, [12_000, 10_000]), 500);
    assert_eq!(breadth(&along_y, [12_000, 10_000]), 600);
    assert_eq!(breadth(&along_y, [0, 0]), 500, "10 mm is assumed");
    // A single taxel and a line are one pixel broad.
    assert_eq!(breadth(&drawn(|x, y| x == 3.0 && y == 63.0).0, [10_000, 10_000]), 100);
    assert_eq!(breadth(&drawn(|_, y| y == 63.0).0, [10_000, 7_000]), 70);
    // A disc of diameter 40: the strip with its variance is sqrt(3) / 2 as broad, and the pixel is counted
    // twice.
    let disc = drawn(|x, y| (x - 32.0).hypot(y - 32.0) < 20.0).0;
    let want = (12.0f64 * 20.0 * 20.0 / 4.0 + 1.0).sqrt() * 100.0;
    assert!((f64::from(breadth(&disc, [10_000, 10_000])) - want).abs() < 0.01 * want);
    assert_eq!(breadth(&Moments::default(), [10_000, 10_000]), 100, "nothing is a pixel");
}

#[test]
fn a_transform_is_exact() {
    let (moments, _) = drawn(|x, y| x * 3.0 + y < 70.0 && y > 4.0);
    let quarter = Transform { xx: 0, xy: -1, yx: 1, yy: 0, dx: 63, dy: -17 };
    let mirror = Transform { xx: -1, xy: 0, yx: 0, yy: 1, dx: -5, dy: 9 };
    for map in [quarter, mirror, quarter.after(&mirror), Transform::IDENTITY] {
        let there = moments.transform(&map);
        assert_eq!(there.transform(&map.inverse()), moments);
        assert_eq!(there.jm(), moments.jm());
        let mut sums = Moments { m: moments.m, s2: moments.s2, ..Moments::default() };
        for (x, y) in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
            if x * 3 + y < 70 && y > 4 {
                let (x, y) = map.apply(x, y, 1);
                sums.sx += x * 1000;
                sums.sy += y * 1000;
                sums.sxx += (x * x * 1000) as u64;
                sums.syy += (y * y * 1000) as u64;
                sums.sxy += x * y * 1000;
            }
        }
        assert_eq!(there, sums);
    }
}
