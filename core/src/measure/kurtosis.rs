//! How the pressure of a contact is distributed along its principal axes, by moments of the fourth order.
//!
//! Moments of the second order cannot tell a rectangle from the ellipse with the same axes. Those of the
//! fourth order can: in a rectangle the position along one axis (u) is independent of that across it (v),
//! while an ellipse has no pressure in its corners.

use super::component::Component;
use super::sight::Sight;
use crate::format::{Fixed16, Turn};
use crate::garment::{Area, Rect};
use crate::segment::run::Run;
use crate::segment::strip::values_of;

/// Standardised moments of the fourth order along the major axis (u) and across it (v), as logarithms to base
/// 2 in 1/1024; all 0 for a contact that has none.
///
/// The square of a coordinate is that of the taxel's centre plus 1/12 for the taxel's own width. Without a
/// direction, u is x. For a contact that crosses a seam, only its home panel counts. Pressures are cut to 8
/// bits, squares to 16 bits of the extent's: at most 10 steps of error up to 32 x 32 taxels (asserted against
/// floats).
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Kurtosis {
    /// `E u^4 / (E u^2)^2`: 1.8 for a rectangle of even pressure, 2 for an ellipse
    pub along: i16,
    /// `E v^4 / (E v^2)^2`
    pub across: i16,
    /// `E u^2 v^2 / (E u^2 E v^2)`: 1 for a rectangle, 2/3 for an ellipse, whatever their sides
    pub mixed: i16,
}

/// A coordinate along one axis of a contact, scaled so that the contact's extent fills an `i32`.
#[derive(Clone, Copy)]
struct ScaledAxis {
    /// Step from a column to the next.
    column: i32,
    /// Step from a row to the next.
    row: i32,
    /// Coordinate of the panel's first taxel.
    origin: i32,
    /// 1/12 taxel^2 in units of [`ScaledAxis::square`].
    pixel: u32,
}

/// Fraction bits of a coordinate of less than two taxels, beyond the 16 that are cut before squaring.
const FINEST: u32 = 14;

impl ScaledAxis {
    /// The axis in a direction (cosine, sine in Q31) through `centre`, scaled to the rectangle `bounds`.
    fn of(direction: [i32; 2], centre: [Fixed16; 2], bounds: &Rect) -> ScaledAxis {
        let sides = [(bounds.left, bounds.right), (bounds.top, bounds.bottom)]
            .map(|(first, last)| u32::from(last.saturating_sub(first)) + 1);
        // In 1/32768 taxel, rounded up by one step.
        let part = |i: usize| sides[i].saturating_mul((direction[i].unsigned_abs() >> 16) + 1);
        let extent = part(0).saturating_add(part(1));
        let coarser = (0..FINEST).find(|coarser| extent >> (coarser + 1) < 1 << 15).unwrap_or(FINEST);
        let [column, row] = direction.map(|cosine| cosine >> (coarser + 1));
        let [x, y] = centre.map(|at| i64::from(at.0));
        // The coordinates of all taxels fit an i32; an intermediate result may wrap and comes back.
        let origin = (-(x * i64::from(column) + y * i64::from(row)) >> 16) as i32;
        // 2^28 / 2^14 / 12
        ScaledAxis { column, row, origin, pixel: 1365 >> (2 * coarser) }
    }

    /// Coordinate of a taxel.
    fn at(&self, column: u16, row: u16) -> i32 {
        let (x, y) = (i32::from(column).wrapping_mul(self.column), i32::from(row).wrapping_mul(self.row));
        self.origin.wrapping_add(x).wrapping_add(y)
    }

    /// Square of a coordinate, plus 1/12 taxel^2; 16 bits.
    #[inline(always)]
    fn square(&self, at: i32) -> u32 {
        (((at >> 16).wrapping_mul(at >> 16) as u32) >> 14) + self.pixel
    }
}

/// Sums over taxels, with a = u^2 and b = v^2 in 16 bits, and the pressure f in 8.
#[derive(Default)]
struct FourthSums {
    /// sum f
    m: u32,
    /// sum a f / 256
    a: u32,
    /// sum b f / 256
    b: u32,
    /// sum a^2 f / 2^14
    aa: u64,
    /// sum b^2 f / 2^14
    bb: u64,
    /// sum a b f / 2^14
    ab: u64,
}

impl FourthSums {
    /// Adds those of at most 32 `values` whose bit in `taxels` is set; bit 0 is the first value, at (u, v).
    #[inline(never)] // M0+: out of line
    fn add(
        &mut self,
        values: &[u16],
        mut taxels: u32,
        down: u16,
        axes: &[ScaledAxis; 2],
        [mut u, mut v]: [i32; 2],
    ) {
        let [along, across] = axes;
        let [mut m, mut a_f, mut b_f, mut aa_f, mut bb_f, mut ab_f] = [0u32; 6];
        for value in values {
            if taxels & 1 == 1 {
                let f = u32::from(value >> down);
                let (a, b) = (along.square(u), across.square(v));
                let [af, bf] = [a, b].map(|square| (square.wrapping_mul(f) + 128) >> 8);
                m += f;
                a_f += af;
                b_f += bf;
                // Below 2^26 each, and there are 32.
                aa_f += a.wrapping_mul(af) >> 6;
                bb_f += b.wrapping_mul(bf) >> 6;
                ab_f += a.wrapping_mul(bf) >> 6;
            }
            taxels >>= 1;
            (u, v) = (u.wrapping_add(along.column), v.wrapping_add(across.column));
        }
        self.m = self.m.wrapping_add(m);
        self.a = self.a.wrapping_add(a_f);
        self.b = self.b.wrapping_add(b_f);
        self.aa = self.aa.wrapping_add(aa_f.into());
        self.bb = self.bb.wrapping_add(bb_f.into());
        self.ab = self.ab.wrapping_add(ab_f.into());
    }

    fn kurtosis(&self) -> Kurtosis {
        if self.a == 0 || self.b == 0 {
            return Kurtosis::default();
        }
        let [m, a, b] = [self.m, self.a, self.b].map(|sum| log2(sum.into()));
        // m (sum a^2 f / 2^14) 2^14 / (sum a f / 2^8)^2 / 2^16
        let of = |sum: u64, first: i32, second: i32| {
            let log = m + log2(sum) - first - second - (2 << 10);
            log.clamp(i16::MIN.into(), i16::MAX.into()) as i16
        };
        Kurtosis { along: of(self.aa, a, a), across: of(self.bb, b, b), mixed: of(self.ab, a, b) }
    }
}

impl Kurtosis {
    /// Measures contact number `index`, which continues as `component`, along the direction of its major axis.
    #[inline(never)] // own frame: locals stay within short SP offsets
    pub(super) fn of<const RUNS: usize, const LABELS: usize>(
        azimuth: Option<Turn>,
        index: u16,
        component: &Component,
        sight: &Sight<'_, RUNS, LABELS>,
    ) -> Kurtosis {
        let panel = component.bounds.panel;
        let Some(area) = sight.layout.areas().get(usize::from(panel)) else { return Kurtosis::default() };
        let runs = || {
            let all = component.runs(sight.labeller, sight.layout).map(|(_, run)| run);
            all.filter(|run| {
                let label = sight.labeller.labels.get(usize::from(run.label));
                label.is_some_and(|label| label.contact == index && label.panel == panel)
            })
        };
        let centre = if component.joined { centroid(runs(), area) } else { [component.x, component.y] };
        let (cos, sin) = azimuth.map_or((i32::MAX, 0), |turn| idsp::cossin(turn.0));
        let axes = [[cos, sin], [sin.saturating_neg(), cos]]
            .map(|direction| ScaledAxis::of(direction, centre, &component.bounds));
        // Eight bits of the peak are left.
        let down = 8u32.saturating_sub(component.peak.leading_zeros()) as u16;
        let mut sums = FourthSums::default();
        for run in runs() {
            let at = axes.map(|axis| axis.at(run.left, run.row - area.first_row));
            sums.add(values_of(run, area, sight.image.values), run.rebased(), down, &axes, at);
        }
        sums.kurtosis()
    }
}

/// Centroid of the runs of one panel.
#[cold]
#[inline(never)]
fn centroid<'a>(runs: impl Iterator<Item = &'a Run>, area: &Area) -> [Fixed16; 2] {
    let mut sum = [0u64; 3];
    for run in runs {
        let [s0, s1] = [run.sums.s0, run.sums.s1].map(u64::from);
        let [x, y] = [run.left, run.row - area.first_row].map(u64::from);
        sum = [sum[0] + s0, sum[1] + x * s0 + s1 - s0, sum[2] + y * s0];
    }
    let [m, x, y] = sum;
    [x, y].map(|sum| Fixed16((sum << 16).checked_div(m).unwrap_or(0) as i32))
}
/// Logarithm to base 2 in 1/1024, two steps off at most, 0 for 0: that of the mantissa 1 + f is `f + f (1 - f)
/// (P - Q f)`.
fn log2(value: u64) -> i32 {
    let zeros = (value | 1).leading_zeros();
    let f = ((value << zeros << 1) >> 48) as u32;
    let bend = (((f * (65_536 - f)) >> 16) * (BEND - ((f * TILT) >> 16))) >> 10;
    (63 - zeros as i32) * 1024 + ((f + bend + 32) >> 6) as i32
}

/// P and Q of [`log2`] in 1/1024.
const BEND: u32 = 433;
const TILT: u32 = 163;

#[cfg(test)]
mod tests {
    extern crate std;
    use super::log2;

    #[test]
    fn the_logarithm_is_two_steps_off_at_most() {
        let mut state = 1u64;
        for round in 0..100_000u32 {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let value = (state >> (round % 63)).max(1);
            let want = (value as f64).log2() * 1024.0;
            assert!((f64::from(log2(value)) - want).abs() <= 2.0, "{value}");
        }
        assert_eq!([0, 1, 2, 1 << 40].map(log2), [0, 0, 1 << 10, 40 << 10]);
    }
}
