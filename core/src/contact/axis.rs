//! Direction, elongation and breadth of a contact from its central moments.

use super::moments::{Central, Moments};
use crate::format::{Inverse, Q15, Scaled, Turn, product, root};

/// Pitch that is assumed where a panel does not give one: 10 mm, in micrometres.
pub const ASSUMED_PITCH_UM: u32 = 10_000;

/// The principal axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axis {
    /// Angle of the major axis from +x towards +y, in (-1/4, 1/4] turn; none where the anisotropy is below
    /// `clamp(1 / area, 0.02, 0.15)`. In taxel coordinates, whatever the pitch. At most 1.3e-6 rad off.
    pub azimuth: Option<Turn>,
    /// `D / J = sqrt((A - B)^2 + 4 C^2) / (A + B)`: 0 for a disc or square, 1 for a line. Half a step off at most, and 1e-8.
    pub anisotropy: Q15,
}

/// Numbers of the common scale that leaves 31 bits to the sum `A + B`.
#[derive(Clone, Copy)]
struct Normal {
    a: u64,
    b: u64,
    c: i64,
    /// `value = normal * 2^exponent`
    exponent: i16,
}

impl Normal {
    fn of(a: u64, b: u64, c: i64) -> Normal {
        let spare = a.wrapping_add(b).leading_zeros() as i16;
        match spare - 33 {
            up @ 0.. => Normal { a: a << up, b: b << up, c: c << up, exponent: -up },
            down => Normal { a: a >> -down, b: b >> -down, c: c >> -down, exponent: -down },
        }
    }

    /// `A - B`, `2 C` and `sqrt((A - B)^2 + 4 C^2)`.
    fn spread(&self) -> (i64, i64, u64) {
        let (difference, mixed) = ((self.a as i64).wrapping_sub(self.b as i64), self.c.wrapping_mul(2));
        let (x, y) = (difference.unsigned_abs(), mixed.unsigned_abs());
        // Both are at most 2^31 but for the bits that were cut: the sum of the squares fits.
        (difference, mixed, root(product(x, x).wrapping_add(product(y, y))).into())
    }

    fn axis(&self, area: u32) -> Axis {
        let (difference, mixed, d) = self.spread();
        let anisotropy = Q15::ratio(d, self.a.wrapping_add(self.b));
        // Not below 32768 / area, rounded down, without the division.
        let share = anisotropy.0 as u32;
        let clear = share >= 4915 || (share >= 655 && (share + 1).saturating_mul(area) > 32768);
        let defined = d > 0 && clear;
        Axis { azimuth: defined.then(|| half_angle(mixed, difference)), anisotropy }
    }

    /// See [`breadth`]; of a contact of mass `m`.
    fn breadth(&self, m: u64, pitch_um: [u32; 2]) -> u32 {
        // Beyond 655 mm the squares would not leave room; no garment is that coarse.
        let [px, py] = pitch_um.map(|p| {
            // A hundredth by multiplication: exact below 2^30.
            let um = if p == 0 { ASSUMED_PITCH_UM } else { p.min(655_399) };
            (product(um.into(), 42_949_673) >> 32).clamp(1, 6553)
        });
        let pixel = px * px + py * py;
        let c = product(self.c.unsigned_abs(), px * py) as i64;
        let c = if self.c < 0 { c.wrapping_neg() } else { c };
        let normal = Normal::of(product(self.a, px * px), product(self.b, py * py), c);
        let (difference, _, d) = normal.spread();
        // Twice the pixel's square across: px^2 + py^2 - (px^2 - py^2)(A - B) / D.
        let skew = (px * px) as i64 - (py * py) as i64;
        let lean = if d == 0 || skew == 0 {
            0
        } else {
            i64::from(Inverse::of(d as u32).nearest(skew.wrapping_mul(difference)))
        };
        let pixel2 = (pixel as i64 - lean).max(0) as u64;
        // 2 w^2 = 12 (A + B - D) / m^2 + pixel2
        let minor = normal.a.wrapping_add(normal.b).saturating_sub(d);
        let exponent = self.exponent + normal.exponent;
        let strip = if m == 0 {
            Scaled::ZERO
        } else {
            let inverse = Scaled::from_u64(1).over(Scaled::from_u64(m));
            Scaled::from_u64(minor.wrapping_mul(12)).times(inverse).times(inverse).shifted(exponent)
        };
        // Eight fraction bits, which a width of one pixel needs.
        let sum = strip.to_wide(8).saturating_add(pixel2 << 8);
        Scaled::from_u64(sum).shifted(-9).sqrt().to_fixed(0)
    }
}

/// Azimuth and anisotropy of a contact of `area` taxels (0 counts as 1).
///
/// For moments of a contact: `A + B < 2^64`, which `Layout::build` asserts, and `|2 C| <= A + B`. Where these do not hold, as
/// for sums that wrapped, the result means nothing; the function is total all the same.
pub fn axis(central: &Central, area: u32) -> Axis {
    Normal::of(central.a, central.b, central.c).axis(area)
}

/// Axis, and [`breadth`], of a contact of `area` taxels.
pub(super) fn axis_and_breadth(moments: &Moments, area: u32, pitch_um: [u32; 2]) -> (Axis, u32) {
    let central = moments.central();
    let normal = Normal::of(central.a, central.b, central.c);
    (normal.axis(area), normal.breadth(moments.m, pitch_um))
}

/// Half the angle of the point (x, y), in (-1/4, 1/4] turn.
fn half_angle(y: i64, x: i64) -> Turn {
    let greater = x.unsigned_abs().max(y.unsigned_abs()) | 1;
    // Up to 30 bits, so that the smaller of the two keeps its digits.
    let (x, y) = match greater.leading_zeros() as i32 - 34 {
        up @ 0.. => (x << up, y << up),
        down => (x >> -down, y >> -down),
    };
    let half = idsp::atan2(y as i32, x as i32) >> 1;
    Turn(if half == -(1 << 30) { 1 << 30 } else { half })
}

/// Width across the major axis, in 0.1 mm: that of the uniform strip with the same variance across,
/// `w^2 = 12 variance + pixel^2`, where the pixel is a rectangle of the pitch as seen along that direction. Moments are
/// taken to millimetres first, so that a pitch that differs along the axes is honoured.
///
/// A pitch that is 0 counts as 10 mm, and every other is cut to 0.1 mm and held within 0.1 and 655.3 mm. At pitches of 2 to 30 mm
/// that differ by a factor of 4 at most, the result is rounded to the nearest: 0.501 steps off at most. A contact that is all but
/// isotropic on the cloth (anisotropy below 2^-13) has no direction along which to see the pixel, so that the difference of the
/// two pitches comes on top. As [`axis`], it is total, and means nothing for sums that wrapped.
pub fn breadth(moments: &Moments, pitch_um: [u32; 2]) -> u32 {
    let central = moments.central();
    Normal::of(central.a, central.b, central.c).breadth(moments.m, pitch_um)
}
