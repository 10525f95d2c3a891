//! Exact moments of pressure (eq. 1 to 3 of the source, with coordinates from 0).

use crate::format::product;
use crate::garment::{Transform, signed};

/// Sums over the taxels of a contact, or of an image, with f the pressure in counts.
///
/// All are exact integers; what is derived from them ([`Moments::jm`], [`Moments::central`]) is exact as well wherever
/// `(full scale N)^2 (w^2 + h^2 - 2) / 12 < 2^64`, which `Layout::build` asserts for the full scale that it is given:
/// give it `u16::MAX`, or keep values within what it was given. Beyond that the results wrap; nothing panics.
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

/// Second moments about the centroid, times the mass: `A = m sxx - sx^2`, `B = m syy - sy^2`, `C = m sxy - sx sy`.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Central {
    /// along x
    pub a: u64,
    /// along y
    pub b: u64,
    /// mixed; `2 |C| <= A + B`
    pub c: i64,
}

/// Taxels whose running sums fit in 32 bits: 65535 * (1 + 3 + 6 + ... + 2080) < 2^32.
const PIECE: usize = 64;
/// Values up to this have squares of which [`PIECE`] fit in 32 bits.
const NARROW: u16 = 8191;

/// What a piece of a row adds, before its place counts.
struct Piece {
    /// sum f
    s0: u32,
    /// sum (i + 1) f
    s1: u32,
    /// sum (i + 1)(i + 2) / 2 f
    s2: u32,
    /// sum f^2
    squares: u64,
}

impl Piece {
    /// At most [`PIECE`] values. From the last to the first, three running sums: no multiplication by a coordinate per
    /// taxel.
    fn of(values: impl DoubleEndedIterator<Item = u32>) -> Piece {
        let (mut s0, mut s1, mut s2, mut squares) = (0u32, 0u32, 0u32, 0u64);
        for value in values.rev() {
            s0 = s0.wrapping_add(value);
            s1 = s1.wrapping_add(s0);
            s2 = s2.wrapping_add(s1);
            squares += u64::from(value * value);
        }
        Piece { s0, s1, s2, squares }
    }

    /// The same of values up to [`NARROW`].
    fn of_narrow(values: impl DoubleEndedIterator<Item = u32>) -> Piece {
        let (mut s0, mut s1, mut s2, mut squares) = (0u32, 0u32, 0u32, 0u32);
        for value in values.rev() {
            s0 = s0.wrapping_add(value);
            s1 = s1.wrapping_add(s0);
            s2 = s2.wrapping_add(s1);
            squares = squares.wrapping_add(value.wrapping_mul(value));
        }
        Piece { s0, s1, s2, squares: squares.into() }
    }
}

/// Values with 0 in the place of those below `floor`.
fn above(floor: u16, values: &[u16]) -> impl DoubleEndedIterator<Item = u32> {
    values.iter().map(move |value| if *value < floor { 0 } else { u32::from(*value) })
}

/// All of them.
fn whole(values: &[u16]) -> impl DoubleEndedIterator<Item = u32> {
    values.iter().map(|value| u32::from(*value))
}

impl Moments {
    /// Of a piece of a row whose first taxel is (x, y).
    pub fn of_run(x: u32, y: u32, values: &[u16]) -> Moments {
        let mut sum = Moments::default();
        sum.add_run(x, y, values, 0, values.iter().copied().max().unwrap_or(0));
        sum
    }

    /// Adds a piece of a row whose first taxel is (x, y): its values from `floor` on, of which none is above `peak`.
    #[inline(never)] // the few registers of an M0+ are for its loop
    pub(super) fn add_run(&mut self, x: u32, y: u32, values: &[u16], floor: u16, peak: u16) {
        if x < 64 && y < 128 && values.len() <= PIECE && peak <= NARROW {
            let piece = match floor {
                0 => Piece::of_narrow(whole(values)),
                _ => Piece::of_narrow(above(floor, values)),
            };
            if piece.s0 < 1 << 17 {
                return self.add_near(x, y, &piece);
            }
        }
        self.add_far(x, y, values, floor);
    }

    /// Small coordinates and sums, as nearly always: everything below 128^2 * 2^17 = 2^31 fits in 32 bits, where a
    /// multiplication takes one cycle instead of 55.
    fn add_near(&mut self, x: u32, y: u32, piece: &Piece) {
        let Piece { s0, s1, s2, squares } = *piece;
        let first = s1.wrapping_sub(s0);
        // i^2 = (i + 1)(i + 2) - 3 (i + 1) + 1; what overflows on the way comes back.
        let second = (s2 << 1).wrapping_add(s0).wrapping_sub(s1.wrapping_mul(3));
        let (sx, sy) = (x * s0 + first, y * s0);
        // sum (x + i)^2 f = x (sum (x + i) f + sum i f) + sum i^2 f
        let sxx = x * (sx + first) + second;
        // One after the other, for want of registers.
        self.m = self.m.wrapping_add(s0.into());
        self.sx = self.sx.wrapping_add(sx.into());
        self.sy = self.sy.wrapping_add(sy.into());
        self.sxx = self.sxx.wrapping_add(sxx.into());
        self.syy = self.syy.wrapping_add((y * sy).into());
        self.sxy = self.sxy.wrapping_add((y * sx).into());
        self.s2 = self.s2.wrapping_add(squares);
    }

    /// Any coordinates, values and length.
    #[cold]
    fn add_far(&mut self, x: u32, y: u32, values: &[u16], floor: u16) {
        let (mut x, y) = (u64::from(x), u64::from(y));
        for values in values.chunks(PIECE) {
            let Piece { s0, s1, s2, squares } = Piece::of(above(floor, values));
            let [s0, s1, s2] = [s0, s1, s2].map(u64::from);
            let first = s1.wrapping_sub(s0);
            let second = (s2 * 2).wrapping_add(s0).wrapping_sub(s1 * 3);
            let (sx, sy) = (x.wrapping_mul(s0).wrapping_add(first), y.wrapping_mul(s0));
            self.add(&Moments {
                m: s0,
                sx: sx as i64,
                sy: sy as i64,
                sxx: x.wrapping_mul(sx.wrapping_add(first)).wrapping_add(second),
                syy: y.wrapping_mul(sy),
                sxy: y.wrapping_mul(sx) as i64,
                s2: squares,
            });
            x += PIECE as u64;
        }
    }

    /// Of a whole image as it stands, row by row.
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

    /// The same pressure in the coordinates that `map` leads to; exact.
    pub fn transform(&self, map: &Transform) -> Moments {
        let Transform { xx, xy, yx, yy, dx, dy } = *map;
        let sum = i64::wrapping_add;
        // The quarter turn or reflection first: of each row and column one factor is 0, the other 1 or -1;
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

    /// `J m = m (sxx + syy) - sx^2 - sy^2`: the moment of inertia about the centroid (eq. 3) times the mass. Every step
    /// wraps, and the result is exact because it fits.
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

    /// Runs on both sides of every limit of the fast paths, against the definition in wide integers.
    #[test]
    fn sums_of_a_run_are_exact_on_every_path() {
        let mut state = 1u32;
        let mut next = |n: u32| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            (state >> 8) % n
        };
        for round in 0..4000 {
            let peak = [1, 4095, NARROW, NARROW + 1, u16::MAX][round % 5];
            let length = [1, 2, 15, 16, 31, 63, 64, 65, 130][round % 9];
            let (x, y) = ([0, 15, 63, 64, 1000][round % 7 % 5], [0, 31, 127, 128, 3000][round % 11 % 5]);
            let least = if round % 2 == 0 { peak } else { 0 };
            let values: Vec<u16> = (0..length).map(|_| least.max(next(u32::from(peak) + 1) as u16)).collect();
            let floor = if round % 3 == 0 { peak / 2 } else { 0 };
            let counted: Vec<u16> = values.iter().map(|f| if *f < floor { 0 } else { *f }).collect();
            let sum = |weight: &dyn Fn(u128) -> u128| -> u128 {
                (u128::from(x)..).zip(&counted).map(|(x, f)| weight(x) * u128::from(*f)).sum()
            };
            let mut have = Moments::default();
            have.add_run(x, y, &values, floor, peak);
            let wide_y = u128::from(y);
            assert_eq!(u128::from(have.m), sum(&|_| 1));
            assert_eq!((have.sx as u128, have.sy as u128), (sum(&|x| x), sum(&|_| wide_y)));
            assert_eq!(u128::from(have.sxx), sum(&|x| x * x));
            assert_eq!(u128::from(have.syy), sum(&|_| wide_y * wide_y));
            assert_eq!(have.sxy as u128, sum(&|x| x * wide_y));
            assert_eq!(u128::from(have.s2), counted.iter().map(|f| u128::from(*f).pow(2)).sum());
            assert_eq!(have, Moments::of_run(x, y, &counted));
        }
    }
}
