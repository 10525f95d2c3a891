//! Direction, elongation and breadth of a contact from its central moments.

use super::moments::{Central, Moments};
use crate::format::{Inverse, Q15, Scaled, Turn, left, right, root, signed_wide, wide};
use crate::garment::ASSUMED_PITCH_UM;

/// Direction and elongation of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Axis {
    /// Angle of the major axis from +x towards +y, in (-1/4, 1/4] turn; none if the anisotropy is below
    /// `clamp(1 / area, 0.02, 0.15)`. In taxel coordinates, whatever the pitch. At most 1.3e-6 rad off.
    pub azimuth: Option<Turn>,
    /// `D / J = sqrt((A - B)^2 + 4 C^2) / (A + B)`: 0 for a disc or square, 1 for a line. At most half a step
    /// plus 1e-8 off.
    pub anisotropy: Q15,
}

/// Central moments, scaled together so that the sum `A + B` has 31 bits.
#[derive(Clone, Copy)]
struct Normal {
    a: u32,
    b: u32,
    c: i32,
    /// `value = normal * 2^exponent`
    exponent: i16,
}

/// `A - B`, `2 C` and `sqrt((A - B)^2 + 4 C^2)`.
struct AxisSpread {
    difference: i32,
    mixed: i32,
    d: u32,
}

impl Normal {
    #[inline]
    fn of(central: &Central) -> Normal {
        let Central { a, b, c } = *central;
        let spare = a.wrapping_add(b).leading_zeros();
        let scaled = |v: u64| if spare >= 33 { left(v, spare - 33) } else { right(v, 33 - spare) } as u32;
        // 31 bits and a sign.
        let c = (scaled(c as u64) << 1) as i32 >> 1;
        Normal { a: scaled(a), b: scaled(b), c, exponent: 33 - spare as i16 }
    }

    fn spread(&self) -> AxisSpread {
        let (difference, mixed) = (self.a.wrapping_sub(self.b) as i32, self.c.wrapping_mul(2));
        let square = |v: i32| wide(v.unsigned_abs(), v.unsigned_abs());
        // Both are at most 2^31, give or take the truncated bits: the sum of the squares fits.
        let d = root(square(difference).wrapping_add(square(mixed)));
        AxisSpread { difference, mixed, d }
    }

    #[inline]
    fn axis(&self, spread: &AxisSpread, area: u32) -> Axis {
        let anisotropy = Q15::ratio(spread.d.into(), self.a.wrapping_add(self.b).into());
        // Tests share >= floor(32768 / area) without the division. Without any spread the share is 0.
        let share = anisotropy.0 as u32;
        let clear = share >= 4915 || (share >= 655 && (share + 1).saturating_mul(area) > 32768);
        Axis { azimuth: clear.then(|| half_angle(spread.mixed, spread.difference)), anisotropy }
    }

    /// `12 (A + B - D) / m^2`: 24 times the variance across the major axis.
    fn across(&self, spread: &AxisSpread, inverse: Scaled) -> Scaled {
        let minor = self.a.wrapping_add(self.b).saturating_sub(spread.d);
        Scaled::from_u64(wide(minor, 12)).times(inverse).times(inverse).shifted(self.exponent)
    }

    /// See [`breadth`].
    fn breadth(&self, spread: &AxisSpread, inverse: Scaled, pitch_um: [u32; 2]) -> u32 {
        let [px, py] = pitch_um.map(tenths);
        let pixel2 = [px, py].map(|p| p * p);
        if px == py {
            // 2 w^2 = (12 (A + B - D) / m^2 + 2) p^2
            let strip = self.across(spread, inverse).to_wide(FRACTION);
            let sum = Scaled::from_u64(strip.saturating_add(2 << FRACTION));
            let square = sum.times(Scaled::from_u64(pixel2[0].into()));
            return square.shifted(-FRACTION - 1).sqrt().to_fixed(0);
        }
        self.oblong(pixel2, px * py).strip(inverse, pixel2)
    }

    /// Scales the moments to lengths on the garment, where a taxel may be oblong.
    fn oblong(&self, [xx, yy]: [u32; 2], xy: u32) -> Normal {
        let c = signed_wide(self.c, xy);
        let normal = Normal::of(&Central { a: wide(self.a, xx), b: wide(self.b, yy), c });
        Normal { exponent: self.exponent + normal.exponent, ..normal }
    }

    /// Width of the strip, if the pitches along the axes differ.
    fn strip(&self, inverse: Scaled, [xx, yy]: [u32; 2]) -> u32 {
        let spread = self.spread();
        // Twice the squared width of a taxel across the major axis: px^2 + py^2 - (px^2 - py^2)(A - B) / D.
        let skew = i64::from(xx) - i64::from(yy);
        let lean = match spread.d {
            0 => 0,
            d => i64::from(Inverse::of(d).nearest(skew.wrapping_mul(spread.difference.into()))),
        };
        let pixel2 = (i64::from(xx + yy) - lean).max(0) as u64;
        // Eight fraction bits: a width of one taxel needs them.
        let sum = self.across(&spread, inverse).to_wide(8).saturating_add(pixel2 << 8);
        Scaled::from_u64(sum).shifted(-9).sqrt().to_fixed(0)
    }
}

/// Fraction bits of a strip's squared width, in taxels.
const FRACTION: i16 = 24;

/// Returns a pitch in 0.1 mm, rounded down and clamped to 0.1 to 655.3 mm; 10 mm if it is 0.
pub(crate) fn tenths(pitch_um: u32) -> u32 {
    // Beyond 655 mm the squares would overflow; no garment is that coarse.
    let um = if pitch_um == 0 { ASSUMED_PITCH_UM } else { pitch_um.min(655_399) };
    // Division by 100 as a multiplication: exact below 2^30.
    ((wide(um, 42_949_673) >> 32) as u32).clamp(1, 6553)
}

/// Azimuth and anisotropy of a contact of `area` taxels (0 counts as 1).
///
/// Moments of a contact meet `A + B < 2^64`, which `Layout::build` asserts, and `|2 C| <= A + B`. Otherwise
/// (sums that wrapped) the result has no meaning, but the function does not panic.
pub fn axis(central: &Central, area: u32) -> Axis {
    let normal = Normal::of(central);
    normal.axis(&normal.spread(), area)
}

/// Returns the axis and the [`breadth`] of a contact of `area` taxels; `inverse` is that of its mass.
#[inline(never)]
pub(crate) fn axis_and_breadth(
    moments: &Moments,
    inverse: &Inverse,
    area: u32,
    pitch_um: [u32; 2],
) -> (Axis, u32) {
    let normal = Normal::of(&moments.central());
    let spread = normal.spread();
    (normal.axis(&spread, area), normal.breadth(&spread, Scaled::inverse(inverse), pitch_um))
}

/// Returns half the angle of the point (x, y), in (-1/4, 1/4] turn.
fn half_angle(y: i32, x: i32) -> Turn {
    let greater = x.unsigned_abs().max(y.unsigned_abs()) | 1;
    // Scaled to 30 bits, so that the smaller of the two keeps its digits.
    let (x, y) = match greater.leading_zeros() {
        spare @ 2.. => (x << (spare - 2), y << (spare - 2)),
        spare => (x >> (2 - spare), y >> (2 - spare)),
    };
    let half = idsp::atan2(y, x) >> 1;
    Turn(if half == -(1 << 30) { 1 << 30 } else { half })
}

/// Width across the major axis, in 0.1 mm: that of the uniform strip with the same variance across,
/// `w^2 = 12 variance + pixel^2`, where the pixel is a rectangle of the pitch as seen along that direction.
/// Moments are scaled to millimetres first, so that the pitches along the axes may differ.
///
/// A pitch of 0 counts as 10 mm; every other is rounded down to 0.1 mm and clamped to 0.1 to 655.3 mm. At
/// pitches of 2 to 30 mm that differ by a factor of 4 at most, the result is rounded to the nearest: 0.501
/// steps off at most. A contact that is nearly isotropic on the garment (anisotropy below 2^-13) has no
/// direction along which to see the pixel, so that the difference of the two pitches adds to the error. The
/// function does not panic for sums that wrapped, but the result has no meaning.
pub fn breadth(moments: &Moments, pitch_um: [u32; 2]) -> u32 {
    let normal = Normal::of(&moments.central());
    let inverse = Scaled::from_u64(1).over(Scaled::from_u64(moments.m));
    normal.breadth(&normal.spread(), inverse, pitch_um)
}
