//! Distribution of the pressure of a touch about its centroid: sums of the third and fourth order.

use super::patch::Patch;
use crate::contact::Moments;
use crate::format::{Scaled, product};

/// Sums over a patch, in coordinates (x, y) from the centroid in units of `2^-bits` taxel, rounded to the
/// nearest; r is the distance. Values of more than 14 bits are truncated to 14.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Spread {
    /// Fraction bits of the coordinates: the most that keep all sums in 63 bits for 4,096 taxels.
    pub bits: i16,
    /// sum f
    pub m: u64,
    /// sum r^2 f
    pub r2: u64,
    /// sum r^4 f / 256
    pub r4: u64,
    /// sum (x, y) r^2 f: lean to one side
    pub lean: [i64; 2],
    /// sum (x + iy)^3 f: three corners
    pub three: [i64; 2],
    /// sum (x + iy)^4 f / 256: four corners
    pub four: [i64; 2],
}

impl Spread {
    /// Returns the sums of a patch, from its moments (coordinates from its first taxel) and its peak.
    pub fn of(patch: &Patch, moments: &Moments, peak: u16) -> Spread {
        // Two taxels are at most 1.42 times the extent apart, below 2^11 units; f < 2^14, and there are 2^12
        // taxels.
        let down = (0..24).find(|down| (patch.extent() << 8) >> down <= 1446).unwrap_or(24);
        let mut spread = Spread { bits: 8 - down as i16, ..Spread::default() };
        let mass = Scaled::from_u64(moments.m);
        let [x0, y0] = [moments.sx, moments.sy].map(|sum| {
            let place = Scaled::from_u64(sum.unsigned_abs()).over(mass).to_fixed(16);
            // Minus half a unit, so that the shifts below round to the nearest.
            i64::from(place) - (1 << (7 + down))
        });
        let dim = u16::from(peak >= 1 << 14) * 2;
        for (row, y) in patch.rows().zip(0i64..) {
            let y = (((y << 16) - y0) >> (8 + down)) as i32;
            for (value, x) in row.iter().zip(0i64..).filter(|(value, _)| **value > 0) {
                spread.add((((x << 16) - x0) >> (8 + down)) as i32, y, u32::from(value >> dim));
            }
        }
        spread
    }

    fn add(&mut self, x: i32, y: i32, f: u32) {
        let (xx, yy, xy2) = (x.wrapping_mul(x), y.wrapping_mul(y), x.wrapping_mul(y) << 1);
        let (r2, across) = ((xx.wrapping_add(yy)) as u32, xx.wrapping_sub(yy));
        let r2f = u64::from(r2) * u64::from(f);
        self.m += u64::from(f);
        self.r2 = self.r2.wrapping_add(r2f);
        // Factors that are squared once more are cut to 18 bits.
        self.r4 = self.r4.wrapping_add(product(product((r2 >> 4).into(), (r2 >> 4).into()), f.into()));
        let add = |sum: &mut i64, term: i64| *sum = sum.wrapping_add(term);
        add(&mut self.lean[0], i64::from(x).wrapping_mul(r2f as i64));
        add(&mut self.lean[1], i64::from(y).wrapping_mul(r2f as i64));
        // (x + iy)^3 = (x + iy)^2 (x + iy), and (x + iy)^2 = across + i xy2
        let (f, x, y, across, xy2) =
            (i64::from(f), i64::from(x), i64::from(y), i64::from(across), i64::from(xy2));
        add(&mut self.three[0], (across * x - xy2 * y).wrapping_mul(f));
        add(&mut self.three[1], (across * y + xy2 * x).wrapping_mul(f));
        let (across, xy2) = (across >> 4, xy2 >> 4);
        add(&mut self.four[0], (across * across - xy2 * xy2).wrapping_mul(f));
        add(&mut self.four[1], (2 * across * xy2).wrapping_mul(f));
    }
}

/// Length of a vector, at most 2^-30 of it off.
pub(super) fn length([x, y]: [i64; 2]) -> Scaled {
    let (x, y) = (x.unsigned_abs(), y.unsigned_abs());
    let spare = (x | y).leading_zeros();
    // 31 bits each, so that the squares fit.
    let shift = spare as i16 - 33;
    let [x, y] = [x, y].map(|value| if shift >= 0 { value << shift } else { value >> -shift });
    Scaled::from_u64(product(x, x).wrapping_add(product(y, y))).sqrt().shifted(-shift)
}
