//! Moments by their definition, in 128 bits: what the core's sums are compared with.

use taxel_core::contact::{Central, Moments};

/// Sums over the taxels of a touch by their definition, which no `u64` can wrap.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Plain {
    pub m: i128,
    pub sx: i128,
    pub sy: i128,
    pub sxx: i128,
    pub syy: i128,
    pub sxy: i128,
    pub s2: i128,
    pub peak: u16,
    pub area: u32,
}

impl Plain {
    /// Of taxels x, y, counts.
    pub fn of<T: Copy + Into<i128>>(taxels: &[(T, T, u16)]) -> Plain {
        let mut sum = Plain::default();
        for (x, y, f) in taxels {
            let (x, y, f): (i128, i128, i128) = ((*x).into(), (*y).into(), (*f).into());
            sum.m += f;
            sum.sx += x * f;
            sum.sy += y * f;
            sum.sxx += x * x * f;
            sum.syy += y * y * f;
            sum.sxy += x * y * f;
            sum.s2 += f * f;
        }
        sum.peak = taxels.iter().map(|t| t.2).max().unwrap_or(0);
        sum.area = taxels.iter().filter(|t| t.2 > 0).count() as u32;
        sum
    }

    /// Second moments about the centroid, times the mass: A, B, C.
    pub fn central(&self) -> [i128; 3] {
        let Plain { m, sx, sy, sxx, syy, sxy, .. } = *self;
        [m * sxx - sx * sx, m * syy - sy * sy, m * sxy - sx * sy]
    }

    /// J m
    pub fn jm(&self) -> i128 {
        let [a, b, _] = self.central();
        a + b
    }

    /// Whether the core's sums are the same, to the last bit.
    pub fn agrees(&self, moments: &Moments) -> bool {
        let [a, b, c] = self.central();
        let Central { a: ma, b: mb, c: mc } = moments.central();
        let Moments { m, sx, sy, sxx, syy, sxy, s2 } = *moments;
        let unsigned = [m, sxx, syy, s2, ma, mb, moments.jm()].map(i128::from);
        unsigned == [self.m, self.sxx, self.syy, self.s2, a, b, a + b]
            && [sx, sy, sxy, mc].map(i128::from) == [self.sx, self.sy, self.sxy, c]
    }
}
