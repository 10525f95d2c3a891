//! Exact moments of pressure (eq. 1 to 3 of the source, with coordinates from 0).

use crate::format::product;
use crate::garment::{Transform, signed};
use crate::segment::bits::WORD;
use crate::segment::run::Run;
use crate::segment::sums::{NARROW, RunSums, squares};

/// Sums over the taxels of a contact, or of an image, with f the pressure in counts.
///
/// All are exact integers. [`Moments::jm`] and [`Moments::central`] are exact as well wherever
/// `(full scale N)^2 (w^2 + h^2 - 2) / 12 < 2^64`. `Layout::build` asserts this for the full scale that it is
/// given: give it `u16::MAX`, or keep values within what it was given. Beyond that the results wrap; nothing
/// panics.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Moments {
    /// sum f: mass
    pub m: u64,
    /// sum x f
    pub sx: i64,
    /// sum y f
    pub sy: i64,
    /// sum x^2 f
    pub sxx: u64,
    /// sum y^2 f
    pub syy: u64,
    /// sum x y f
    pub sxy: i64,
    /// sum f^2
    pub s2: u64,
}

/// Second moments about the centroid, times the mass: `A = m sxx - sx^2`, `B = m syy - sy^2`,
/// `C = m sxy - sx sy`.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Central {
    /// Along x.
    pub a: u64,
    /// Along y.
    pub b: u64,
    /// Mixed; `2 |C| <= A + B`.
    pub c: i64,
}

/// Number of rows whose sums fit in 32 bits if [`is_small`] holds; the squares barely: 16^2 * 4095^2 < 2^32.
pub(crate) const FEW: usize = 16;

/// True for a panel of at most 16 columns and 32 rows with values of 12 bits.
pub(crate) const fn is_small(columns: u16, rows: u16, peak: u16) -> bool {
    columns <= 16 && rows <= 32 && peak < 1 << 12
}

/// Moments in 32 bits, where a multiplication takes one cycle instead of 55. For a run near the first
/// column and row, all of them are below 128^2 * 2^17 = 2^31.
#[derive(Default)]
struct Near {
    m: u32,
    sx: u32,
    sy: u32,
    sxx: u32,
    syy: u32,
    sxy: u32,
    s2: u32,
}

impl Near {
    /// sum x f
    #[inline(always)]
    fn first(x: u32, sums: &RunSums) -> u32 {
        (x * sums.s0).wrapping_add(sums.s1).wrapping_sub(sums.s0)
    }

    /// sum x f, sum x^2 f
    #[inline(always)]
    fn across(x: u32, sums: &RunSums) -> (u32, u32) {
        let RunSums { s0, s1, s2, .. } = *sums;
        let first = s1.wrapping_sub(s0);
        let sx = x * s0 + first;
        // i^2 = (i + 1)(i + 2) - 3 (i + 1) + 1; wraps on the way, but the result fits.
        let second = (s2 << 1).wrapping_add(s0).wrapping_sub(s1.wrapping_mul(3));
        // sum (x + i)^2 f = x (sum (x + i) f + sum i f) + sum i^2 f
        (sx, x * (sx + first) + second)
    }

    #[inline(always)]
    fn of(x: u32, y: u32, sums: &RunSums) -> Near {
        let ((sx, sxx), sy) = (Near::across(x, sums), y * sums.s0);
        Near { m: sums.s0, sx, sy, sxx, syy: y * sy, sxy: y * sx, s2: sums.squares }
    }

    #[inline(always)]
    fn wide(&self) -> Moments {
        let Near { m, sx, sy, sxx, syy, sxy, s2 } = *self;
        Moments {
            m: m.into(),
            sx: sx.into(),
            sy: sy.into(),
            sxx: sxx.into(),
            syy: syy.into(),
            sxy: sxy.into(),
            s2: s2.into(),
        }
    }
}

impl Moments {
    /// Moments of no taxel.
    pub(crate) const NONE: Moments = Moments { m: 0, sx: 0, sy: 0, sxx: 0, syy: 0, sxy: 0, s2: 0 };

    /// Moments of a run of a row whose first taxel is (x, y).
    pub fn of_run(x: u32, y: u32, values: &[u16]) -> Moments {
        let mut sum = Moments::default();
        let mut x = x;
        for values in values.chunks(WORD.into()) {
            let mut sums = RunSums::NONE;
            let peak = sums.take(values);
            sum.add_run(x, y, &sums, peak, || squares(values, u32::MAX));
            x = x.wrapping_add(WORD.into());
        }
        sum
    }

    /// Adds a run of a row whose first taxel is (x, y), from the sums of its taxels. Calls `squares` if the
    /// sum of squares may not fit in 32 bits.
    pub(crate) fn add_run(
        &mut self,
        x: u32,
        y: u32,
        sums: &RunSums,
        peak: u16,
        squares: impl FnOnce() -> u64,
    ) {
        if x < 64 && y < 128 && sums.s0 < 1 << 17 && peak <= NARROW {
            self.add_near(x, y, sums);
        } else {
            self.add_far(x, y, sums, squares());
        }
    }

    /// Adds small sums at small coordinates: nearly every run.
    #[inline(never)] // M0+: out of line
    fn add_near(&mut self, x: u32, y: u32, sums: &RunSums) {
        self.add(&Near::of(x, y, sums).wide());
    }

    /// Adds runs of [`FEW`] rows at most. Rows count from `first_row`, the first of the panel; all columns,
    /// rows and values are [`is_small`].
    #[inline(never)] // M0+: out of line
    pub(crate) fn add_few(&mut self, runs: &[Run], first_row: u16) {
        // Three loops, because one would need twice as many registers as there are.
        let mut sum = Near::default();
        for run in runs {
            sum.m = sum.m.wrapping_add(run.sums.s0);
            sum.s2 = sum.s2.wrapping_add(run.sums.squares);
        }
        for run in runs {
            let (sx, sxx) = Near::across(run.left.into(), &run.sums);
            sum.sx = sum.sx.wrapping_add(sx);
            sum.sxx = sum.sxx.wrapping_add(sxx);
        }
        for run in runs {
            let (y, s0) = (u32::from(run.row - first_row), run.sums.s0);
            let (sx, sy) = (Near::first(run.left.into(), &run.sums), y * s0);
            sum.sy = sum.sy.wrapping_add(sy);
            sum.syy = sum.syy.wrapping_add(y * sy);
            sum.sxy = sum.sxy.wrapping_add(y * sx);
        }
        self.add(&sum.wide());
    }

    /// Adds sums of any size at any coordinates.
    #[cold]
    #[inline(never)]
    fn add_far(&mut self, x: u32, y: u32, sums: &RunSums, squares: u64) {
        self.add(&Moments::of_sums(x, y, sums, squares));
    }

    /// Moments of a run of a row whose first taxel is (x, y), from the sums of its taxels.
    #[inline(always)]
    pub(crate) fn of_sums(x: u32, y: u32, sums: &RunSums, squares: u64) -> Moments {
        let (x, y) = (u64::from(x), u64::from(y));
        let [s0, s1, s2] = [sums.s0, sums.s1, sums.s2].map(u64::from);
        let first = s1.wrapping_sub(s0);
        let second = (s2 * 2).wrapping_add(s0).wrapping_sub(s1 * 3);
        let (sx, sy) = (x.wrapping_mul(s0).wrapping_add(first), y.wrapping_mul(s0));
        Moments {
            m: s0,
            sx: sx as i64,
            sy: sy as i64,
            sxx: x.wrapping_mul(sx.wrapping_add(first)).wrapping_add(second),
            syy: y.wrapping_mul(sy),
            sxy: y.wrapping_mul(sx) as i64,
            s2: squares,
        }
    }

    /// Moments of a whole image, row by row.
    pub fn of_image(values: &[u16], columns: usize) -> Moments {
        let mut sum = Moments::default();
        for (y, row) in values.chunks(columns.max(1)).enumerate() {
            sum.add(&Moments::of_run(0, y as u32, row));
        }
        sum
    }

    /// Adds the moments of other taxels in the same coordinates.
    pub const fn add(&mut self, other: &Moments) {
        self.m = self.m.wrapping_add(other.m);
        self.sx = self.sx.wrapping_add(other.sx);
        self.sy = self.sy.wrapping_add(other.sy);
        self.sxx = self.sxx.wrapping_add(other.sxx);
        self.syy = self.syy.wrapping_add(other.syy);
        self.sxy = self.sxy.wrapping_add(other.sxy);
        self.s2 = self.s2.wrapping_add(other.s2);
    }

    /// Returns the moments of this pressure in the coordinates that `map` leads to; exact.
    pub fn transform(&self, map: &Transform) -> Moments {
        let Transform { xx, xy, yx, yy, dx, dy } = *map;
        let sum = i64::wrapping_add;
        // The quarter turn or reflection first: each row and column of it has one 0, and one 1 or -1;
        let x = sum(signed(xx, self.sx), signed(xy, self.sy));
        let y = sum(signed(yx, self.sx), signed(yy, self.sy));
        let (x_x, y_y) = if xx == 0 { (self.syy, self.sxx) } else { (self.sxx, self.syy) };
        let x_y = sum(signed(xx * yy, self.sxy), signed(xy * yx, self.sxy));
        // then the shift.
        let by = |shift: i32, v: i64| if shift == 0 { 0 } else { i64::from(shift).wrapping_mul(v) };
        let m = self.m as i64;
        let (shift_x, shift_y) = (by(dx, m), by(dy, m));
        Moments {
            m: self.m,
            sx: sum(x, shift_x),
            sy: sum(y, shift_y),
            // sum (x + d)^2 f = sum x^2 f + d (2 sum x f + d m)
            sxx: sum(x_x as i64, by(dx, sum(x << 1, shift_x))) as u64,
            syy: sum(y_y as i64, by(dy, sum(y << 1, shift_y))) as u64,
            sxy: sum(x_y, sum(by(dx, sum(y, shift_y)), by(dy, x))),
            s2: self.s2,
        }
    }

    /// `J m = m (sxx + syy) - sx^2 - sy^2`: the moment of inertia about the centroid (eq. 3) times the mass.
    /// Every step wraps, and the result is exact because it fits.
    pub const fn jm(&self) -> u64 {
        let central = self.central();
        central.a.wrapping_add(central.b)
    }

    /// Second moments about the centroid.
    pub const fn central(&self) -> Central {
        let (m, sx, sy) = (self.m, self.sx as u64, self.sy as u64);
        Central {
            a: product(m, self.sxx).wrapping_sub(product(sx, sx)),
            b: product(m, self.syy).wrapping_sub(product(sy, sy)),
            c: product(m, self.sxy as u64).wrapping_sub(product(sx, sy)) as i64,
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    /// Compares with the definition in wide integers, on both sides of every limit of the fast paths.
    #[test]
    fn sums_of_a_run_are_exact_on_every_path() {
        let mut state = 1u32;
        let mut next = |n: u32| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            (state >> 8) % n
        };
        for round in 0..4000 {
            let peak = [1, 4095, NARROW, NARROW + 1, u16::MAX][round % 5];
            let length = [1, 2, 15, 16, 31, 32, 63, 64, 65, 130][round % 10];
            let (x, y) = ([0, 15, 63, 64, 1000][round % 7 % 5], [0, 31, 127, 128, 3000][round % 11 % 5]);
            let least = if round % 2 == 0 { peak } else { 0 };
            let values: Vec<u16> = (0..length).map(|_| least.max(next(u32::from(peak) + 1) as u16)).collect();
            let sum = |weight: &dyn Fn(u128) -> u128| -> u128 {
                (u128::from(x)..).zip(&values).map(|(x, f)| weight(x) * u128::from(*f)).sum()
            };
            let have = Moments::of_run(x, y, &values);
            let wide_y = u128::from(y);
            assert_eq!(u128::from(have.m), sum(&|_| 1));
            assert_eq!((have.sx as u128, have.sy as u128), (sum(&|x| x), sum(&|_| wide_y)));
            assert_eq!(u128::from(have.sxx), sum(&|x| x * x));
            assert_eq!(u128::from(have.syy), sum(&|_| wide_y * wide_y));
            assert_eq!(have.sxy as u128, sum(&|x| x * wide_y));
            assert_eq!(u128::from(have.s2), values.iter().map(|f| u128::from(*f).pow(2)).sum());
        }
    }

    /// The largest possible sums, and smaller ones.
    #[test]
    fn sums_of_few_rows_are_those_of_each() {
        for (first, least) in [(16, 4095), (0, 4095), (7, 0)] {
            let values: [u16; 16] = core::array::from_fn(|i| least.max(i as u16 * 250));
            let mut sums = RunSums::NONE;
            let peak = sums.take(&values);
            let run = |row| Run {
                taxels: 0xffff,
                row: 100 + row,
                label: 0,
                left: 0,
                right: 15,
                area: 16,
                peak,
                sums,
            };
            let runs: Vec<_> = (first..first + FEW as u16).map(run).collect();
            assert!(is_small(16, 32, peak) && runs.iter().all(|run| run.row < 132));
            let (mut few, mut each) = (Moments::default(), Moments::default());
            few.add_few(&runs, 100);
            for run in &runs {
                each.add(&Moments::of_run(0, (run.row - 100).into(), &values));
            }
            assert_eq!(few, each);
        }
    }
}
