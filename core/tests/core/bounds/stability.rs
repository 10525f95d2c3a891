//! What becomes of the same touches in the arithmetic that is usual for them: raw moments in f32, and in
//! Q16.16.

use crate::bounds::images::{self, TouchTaxels, moments};
use crate::plain::Plain;
use crate::random::Noise;
use taxel_core::contact::axis;

/// Variances along x and y and the covariance, each as its arithmetic gives it.
struct Variances {
    xx: f64,
    yy: f64,
    xy: f64,
}

impl Variances {
    fn negative(&self) -> bool {
        self.xx < 0.0 || self.yy < 0.0
    }

    fn anisotropy(&self) -> f64 {
        (self.xx - self.yy).hypot(2.0 * self.xy) / (self.xx + self.yy)
    }

    fn degrees(&self) -> f64 {
        ((2.0 * self.xy).atan2(self.xx - self.yy) / 2.0).to_degrees()
    }

    /// Largest of the two variances' errors, as a share of the exact sum of both.
    fn error(&self, exact: &Variances) -> f64 {
        let off = (self.xx - exact.xx).abs().max((self.yy - exact.yy).abs());
        off / (exact.xx + exact.yy).max(1.0 / 12.0)
    }
}

fn exact(plain: &Plain) -> Variances {
    let square = plain.m as f64 * plain.m as f64;
    let [xx, yy, xy] = plain.central().map(|sum| sum as f64 / square);
    Variances { xx, yy, xy }
}

/// As the core, `m sum x^2 f - (sum x f)^2`, with all of it in f32.
fn single(taxels: &TouchTaxels) -> Variances {
    let mut sums = [0f32; 6];
    for (x, y, f) in taxels {
        let (x, y, f) = (*x as f32, *y as f32, f32::from(*f));
        for (sum, term) in sums.iter_mut().zip([f, x * f, y * f, x * x * f, y * y * f, x * y * f]) {
            *sum += term;
        }
    }
    let [m, sx, sy, sxx, syy, sxy] = sums;
    let [xx, yy, xy] = [m * sxx - sx * sx, m * syy - sy * sy, m * sxy - sx * sy];
    let square = f64::from(m) * f64::from(m);
    let [xx, yy, xy] = [xx, yy, xy].map(|sum| f64::from(sum) / square);
    Variances { xx, yy, xy }
}

/// E[x^2] - E[x]^2 in Q16.16, as a fixed-point library makes it, with 4096 counts for 1; none where a sum
/// does not fit.
fn fixed(taxels: &TouchTaxels) -> Option<Variances> {
    let mut sums = [0i32; 6];
    for (x, y, f) in taxels {
        let (x, y, f) = (i64::from(*x), i64::from(*y), i64::from(*f));
        for (sum, term) in sums.iter_mut().zip([f, x * f, y * f, x * x * f, y * y * f, x * y * f]) {
            *sum = sum.checked_add(i32::try_from(term << 4).ok()?)?;
        }
    }
    let [m, sx, sy, sxx, syy, sxy] = sums.map(i64::from);
    let over = |sum: i64| (sum << 16) / m;
    let (cx, cy) = (over(sx), over(sy));
    let variance = |sum: i64, product: i64| (over(sum) - (product >> 16)) as f64 / 65536.0;
    Some(Variances { xx: variance(sxx, cx * cx), yy: variance(syy, cy * cy), xy: variance(sxy, cx * cy) })
}

/// What an arithmetic did to the touches of a kind.
#[derive(Debug, Default)]
struct ErrorRecord {
    touches: u32,
    overflows: u32,
    negative: u32,
    /// A direction, out of rounding alone, for a touch that has none.
    invented: u32,
    variance: f64,
    /// In degrees, where the touch has a direction.
    azimuth: f64,
}

impl ErrorRecord {
    fn take(&mut self, have: Option<Variances>, exact: &Variances) {
        self.touches += 1;
        let Some(have) = have else {
            self.overflows += 1;
            return;
        };
        self.negative += u32::from(have.negative());
        self.invented += u32::from(exact.anisotropy() == 0.0 && have.anisotropy() != 0.0);
        self.variance = self.variance.max(have.error(exact));
        if exact.anisotropy() >= 0.15 {
            let apart = (have.degrees() - exact.degrees()).rem_euclid(180.0);
            self.azimuth = self.azimuth.max(apart.min(180.0 - apart));
        }
    }

    fn line(&self, kind: &str, arithmetic: &str) -> String {
        let share = |count: u32| 100.0 * f64::from(count) / f64::from(self.touches);
        let [overflows, negative, invented] = [self.overflows, self.negative, self.invented].map(share);
        let ErrorRecord { touches, variance, azimuth, .. } = self;
        let shares = format!("{overflows:8.1} % {negative:8.1} % {invented:8.1} %");
        let errors = if self.overflows == *touches {
            format!("{:>9} {:>9}", "-", "-")
        } else {
            format!("{variance:9.1e} {azimuth:9.1e}")
        };
        format!("{kind:24} {arithmetic:8} {touches:7} {shares} {errors}")
    }
}

/// The core: exact sums, so the only error is that of a float that shows them.
fn core(taxels: &TouchTaxels) -> Variances {
    let moments = moments(taxels);
    let central = moments.central();
    let square = moments.m as f64 * moments.m as f64;
    Variances { xx: central.a as f64 / square, yy: central.b as f64 / square, xy: central.c as f64 / square }
}

/// Up to 3 x 3 taxels of any pressure in the last quarter of both axes.
fn small_and_far() -> impl Iterator<Item = TouchTaxels> {
    let mut noise = Noise(10);
    (0..10_000).map(move |_| {
        let mut some = |limit: u32| noise.below(limit.into()) as u32;
        let (w, h) = (1 + some(3), 1 + some(3));
        let (left, top) = (24 + some(9 - w), 48 + some(17 - h));
        (0..w * h).map(|i| (left + i % w, top + i / w, 1 + some(4095) as u16)).collect()
    })
}

/// Three taxels of a row at its far end.
fn end_of_a_strip() -> impl Iterator<Item = TouchTaxels> {
    let mut noise = Noise(11);
    (0..10_000).map(move |_| (473..476).map(|x| (x, 0, 1 + noise.below(4095) as u16)).collect())
}

fn saturated_squares() -> impl Iterator<Item = TouchTaxels> {
    let square = |side: u32| (0..side * side).map(|i| (31 - i % side, 63 - i / side, 4095)).collect();
    (2..=32).map(square)
}

#[test]
fn usual_arithmetic_fails_where_the_core_is_exact() {
    let head = ["touches", "numbers", "count", "overflow", "negative", "invented", "variance", "azimuth"];
    let [kind, numbers, count, overflow, negative, invented, variance, azimuth] = head;
    let mut lines = vec![format!(
        "{kind:24} {numbers:8} {count:>7} {overflow:>10} {negative:>10} {invented:>10} {variance:>9} {azimuth:>9}"
    )];
    let mut records = Vec::new();
    let kinds: [(&str, Box<dyn Iterator<Item = TouchTaxels>>); 4] = [
        ("small, in the far corner", Box::new(small_and_far())),
        ("end of a strip of 476", Box::new(end_of_a_strip())),
        ("saturated squares", Box::new(saturated_squares())),
        ("full panel, 11 or 16 bit", Box::new(images::textures(100))),
    ];
    for (kind, touches) in kinds {
        let mut record: [ErrorRecord; 3] = Default::default();
        for taxels in touches {
            let exact = exact(&Plain::of(&taxels));
            let forms = [Some(single(&taxels)), fixed(&taxels), Some(core(&taxels))];
            record.iter_mut().zip(forms).for_each(|(record, have)| record.take(have, &exact));
        }
        for (record, arithmetic) in record.iter().zip(["f32", "Q16.16", "core"]) {
            lines.push(record.line(kind, arithmetic));
        }
        records.push(record);
    }
    println!("{}", lines.join("\n"));
    assert!(
        include_str!("../../../../docs/evidence/bounds.md").contains(&lines.join("\n")),
        "docs/evidence/bounds.md has another table"
    );
    for [_, _, core] in &records {
        assert_eq!((core.overflows, core.negative, core.invented), (0, 0, 0));
        assert!(core.variance < 1e-14 && core.azimuth < 1e-9, "{core:?}");
    }
    let [small, strip, squares, full] = [0, 1, 2, 3].map(|kind| &records[kind]);
    // f32: variances below zero, and directions of squares.
    assert!(small[0].negative * 200 >= small[0].touches, "{:?}", small[0]);
    assert!(strip[0].variance > 0.1, "{:?}", strip[0]);
    assert!(squares[0].invented > 15, "{:?}", squares[0]);
    // Q16.16: what is larger than a few taxels does not fit.
    assert!(squares[1].overflows + 1 == squares[1].touches, "all but the smallest: {:?}", squares[1]);
    assert!(full[1].overflows == full[1].touches && small[1].azimuth > 5.0, "{:?}", small[1]);
}

/// A square has no direction: f32 gives it one, and the ninth saturated taxel of the last row is more than
/// Q16.16 can hold.
#[test]
fn an_isotropic_square_and_the_ninth_taxel() {
    let by_anisotropy = |(a, _): &(Variances, TouchTaxels), (b, _): &(Variances, TouchTaxels)| {
        a.anisotropy().total_cmp(&b.anisotropy())
    };
    let squares = saturated_squares().map(|square| (single(&square), square));
    let (wrong, square) = squares.max_by(by_anisotropy).expect("squares");
    println!("f32: a square of {} taxels points to {:.0} degrees", square.len(), wrong.degrees());
    assert!(wrong.anisotropy() > 0.0);
    let axis = axis(&moments(&square).central(), square.len() as u32);
    assert_eq!((axis.azimuth, axis.anisotropy.0), (None, 0));
    // 63^2 n < 2^15 up to n = 8.
    let row = |n: u32| (0..n).map(|x| (x, 63, 4095)).collect();
    assert!(fixed(&row(8)).is_some() && fixed(&row(9)).is_none());
}
