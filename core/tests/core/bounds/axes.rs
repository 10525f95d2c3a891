//! Azimuth, anisotropy and breadth against 60 digits.

use crate::bounds::exact::{Real, pi};
use crate::bounds::images::{self, moments};
use crate::bounds::table::bound;
use crate::plain::Plain;
use crate::random::Noise;
use num_bigint::BigInt;
use proptest::prelude::*;
use taxel_core::contact::{Axis, Central, Moments, axis, breadth};
use taxel_core::format::{Q15, Turn};

/// `sqrt((A - B)^2 + 4 C^2)` and `A + B`.
fn spread([a, b, c]: [i128; 3]) -> (Real, i128) {
    let square = BigInt::from(a - b) * (a - b) + BigInt::from(4) * c * c;
    (Real::whole(square).sqrt(), a + b)
}

fn anisotropy(central: [i128; 3]) -> Real {
    match spread(central) {
        (_, 0) => Real::whole(0),
        (d, sum) => d / Real::whole(sum),
    }
}

/// Distance of two axes, in radians: modulo half a turn.
fn apart(have: Turn, [a, b, c]: [i128; 3]) -> f64 {
    let have = Real::ratio(have.0, 1i64 << 31) * pi();
    let difference = (have - Real::half_angle(2 * c, a - b)).abs();
    let other = (pi() - difference.clone()).abs();
    difference.min(other).to_f64()
}

/// The limit of the azimuth in steps of 2^-15: clamp(1 / area, 0.02, 0.15), cut.
fn limit(area: u32) -> i32 {
    (32768 / area).clamp(655, 4915) as i32
}

#[derive(Default)]
struct Worst {
    count: u32,
    defined: u32,
    azimuth: f64,
    anisotropy: f64,
}

impl Worst {
    fn take(&mut self, central: [i128; 3], area: u32) {
        let [a, b, c] = central;
        let Axis { azimuth, anisotropy: have } =
            axis(&Central { a: a as u64, b: b as u64, c: c as i64 }, area);
        let error = (Real::ratio(have.0, 32768) - anisotropy(central)).abs().to_f64();
        self.anisotropy = self.anisotropy.max(error);
        // Whether there is a direction follows from what is reported, so that a reader can know.
        assert_eq!(azimuth.is_some(), have.0 >= limit(area), "{central:?} {area}");
        if let Some(azimuth) = azimuth {
            assert!(azimuth.0 > -(1 << 30) && azimuth.0 <= 1 << 30);
            let error = apart(azimuth, central);
            self.azimuth = self.azimuth.max(error);
            self.defined += 1;
        }
        self.count += 1;
    }

    fn judge(&self) {
        let Worst { count, defined, azimuth, anisotropy } = self;
        println!("{count} contacts, anisotropy {anisotropy:.3e}, {defined} azimuths {azimuth:.3e} rad");
        assert!(*azimuth <= bound("azimuth", "axes_are_within_their_bounds").absolute);
        assert!(*anisotropy <= bound("anisotropy", "axes_are_within_their_bounds").absolute);
    }
}

#[test]
fn axes_are_within_their_bounds() {
    let mut worst = Worst::default();
    for taxels in images::all() {
        let plain = Plain::of(&taxels);
        worst.take(plain.central(), plain.area);
    }
    assert!(worst.count > 35_000 && worst.defined > 20_000);
    worst.judge();
}

/// Every direction at every magnitude up to the 64th bit, and just above the limit, where it is worst defined.
#[test]
fn axes_hold_at_every_magnitude() {
    let mut noise = Noise(7);
    let mut worst = Worst::default();
    for round in 0..40_000u32 {
        let bits = 3 + noise.below(61) as i32;
        let angle = noise.below(1 << 40) as f64 * 2f64.powi(-40) * std::f64::consts::TAU;
        let part = match round % 4 {
            0 => noise.below(1000) as f64 / 1000.0,
            1 => 1.0,
            2 => 0.02 + noise.below(1000) as f64 * 1e-7,
            _ => 0.15,
        };
        let size = 2f64.powi(bits) * (0.5 + noise.below(1 << 30) as f64 / f64::from(1u32 << 31));
        let (x, y) = (angle.cos() * part * size, angle.sin() * part * size);
        let (a, b) = (((size + x) / 2.0) as u64, ((size - x) / 2.0) as u64);
        // As no touch does, the rounding may make |2 C| > A + B by a unit.
        let most = 2.0 * ((a as f64) * (b as f64)).sqrt();
        let c = (y.clamp(-most, most) / 2.0) as i64;
        worst.take([a.into(), b.into(), c.into()], 4096);
    }
    worst.judge();
}

#[test]
fn a_touch_without_extent_has_no_axis() {
    assert_eq!(axis(&Central::default(), 0), Axis { azimuth: None, anisotropy: Q15(0) });
    assert_eq!(axis(&Central::default(), 2048).azimuth, None);
    // The last bit: one unit of anisotropy in one of the moments is a line.
    assert_eq!(axis(&Central { a: 1, b: 0, c: 0 }, 2), Axis { azimuth: Some(Turn(0)), anisotropy: Q15::ONE });
    let full = Central { a: u64::MAX, b: 0, c: 0 };
    assert_eq!(axis(&full, 2048).anisotropy, Q15::ONE);
}

/// What eccentricity a reader gets from the anisotropy: e^2 = 1 - minor / major = 2 r / (1 + r).
#[test]
fn eccentricity_follows_from_the_anisotropy() {
    let all = bound("eccentricity, from the anisotropy", "eccentricity_follows_from_the_anisotropy");
    let clear = bound("the same, anisotropy 0.02 or more", "eccentricity_follows_from_the_anisotropy");
    let (mut worst, mut worst_clear, mut count) = (0f64, 0f64, 0);
    for taxels in images::all() {
        let central = Plain::of(&taxels).central();
        let exact = anisotropy(central);
        let two = || Real::whole(2);
        let want = (two() * exact.clone() / (Real::whole(1) + exact.clone())).sqrt().to_f64();
        let [a, b, c] = central;
        let r = axis(&Central { a: a as u64, b: b as u64, c: c as i64 }, 2048).anisotropy.to_f64();
        let error = ((2.0 * r / (1.0 + r)).sqrt() - want).abs();
        worst = worst.max(error);
        if exact.to_f64() >= 0.02 {
            worst_clear = worst_clear.max(error);
        }
        count += 1;
    }
    println!("{count} contacts: eccentricity {worst:.3e}, {worst_clear:.3e} from an anisotropy of 0.02 on");
    assert!(worst <= all.absolute && worst_clear <= clear.absolute);
}

/// Pitches in micrometres: the reference garment's, fine and coarse cloth, 4 to 1 both ways.
const PITCHES: [[u32; 2]; 6] =
    [[10_000, 10_000], [12_000, 10_000], [2_000, 2_000], [2_000, 8_000], [30_000, 7_500], [29_900, 30_000]];

/// `w^2 = 12 variance across + pixel^2`, in 0.1 mm, and whether the direction is clear: where the anisotropy
/// is below 2^-13 it is lost among the bits that are cut, if there is one at all.
fn exact_breadth(plain: &Plain, [px, py]: [i128; 2]) -> (Real, bool) {
    let [a, b, c] = plain.central();
    let central = [a * px * px, b * py * py, c * px * py];
    let (d, sum) = spread(central);
    let (square, skew) = (px * px + py * py, px * px - py * py);
    let lean = if d == Real::whole(0) {
        Real::whole(0)
    } else {
        Real::whole(BigInt::from(skew) * (central[0] - central[1])) / d.clone()
    };
    let clear = Real::whole(8192) * d.clone() >= Real::whole(sum);
    let strip = Real::whole(12) * (Real::whole(sum) - d) / Real::whole(BigInt::from(plain.m) * plain.m);
    (((strip + Real::whole(square) - lean) / Real::whole(2)).sqrt(), clear)
}

#[test]
fn breadth_is_within_its_bound() {
    let stated = bound("breadth", "breadth_is_within_its_bound");
    let (mut count, mut unclear, mut worst, mut worst_unclear) = (0, 0, 0f64, 0f64);
    let crosses = images::crosses().map(|cross| (cross, [12_000, 10_000]));
    for (taxels, pitch) in images::all().zip(PITCHES.into_iter().cycle()).chain(crosses) {
        let plain = Plain::of(&taxels);
        let (want, clear) = exact_breadth(&plain, pitch.map(|p| i128::from(p / 100)));
        let error = (Real::whole(breadth(&moments(&taxels), pitch)) - want).abs().to_f64();
        count += 1;
        if clear || pitch[0] == pitch[1] {
            assert!(error <= stated.absolute, "{error} {pitch:?} {taxels:?}");
            worst = worst.max(error);
        } else {
            assert!(
                error <= stated.absolute + f64::from(pitch[0].abs_diff(pitch[1]) / 100),
                "{error} {taxels:?}"
            );
            worst_unclear = worst_unclear.max(error);
            unclear += 1;
        }
    }
    println!(
        "{count} contacts, largest error {worst:.5} of 0.1 mm; {unclear} without direction, {worst_unclear:.2}"
    );
    assert!(count > 38_000 && unclear > 100);
}

#[test]
fn breadth_outside_its_range() {
    let one = moments(&vec![(3, 4, 100)]);
    // No pitch is 10 mm, less than 0.1 mm is 0.1 mm, more than 655.3 mm is that; between, cut to 0.1 mm.
    let of = |pitch: u32| breadth(&one, [pitch, pitch]);
    assert_eq!([of(0), of(1), of(99), of(u32::MAX), of(12_399)], [100, 1, 1, 6553, 123]);
    assert_eq!(breadth(&Moments::default(), [0, 0]), 100);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Whatever the numbers are, sums that wrapped too: these tests are built with checks of overflow.
    #[test]
    fn axes_are_total(
        bits in 0..64u32,
        a: u64, b: u64, c: i64, m: u64, sx: i64, sy: i64, sxx: u64, syy: u64, sxy: i64,
        area: u32,
        pitch: [u32; 2],
    ) {
        let Axis { azimuth, anisotropy } = axis(&Central { a: a >> bits, b: b >> bits, c: c >> bits }, area);
        prop_assert!((0..=32768).contains(&anisotropy.0));
        prop_assert!(azimuth.is_none_or(|a| a.0 > -(1 << 30) && a.0 <= 1 << 30));
        let any = Moments { m: m >> bits, sx, sy, sxx, syy, sxy, s2: a };
        breadth(&any, pitch);
    }
}
