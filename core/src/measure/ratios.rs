//! Sums of the fourth order, made independent of pressure and size.

/// Bits that are cut from a pressure times a square, before it is multiplied again.
pub(super) const PRODUCT: u32 = 8;

/// Turns sums of the fourth order, of which [`PRODUCT`] bits are cut, into ratios, by 16 bits of each: a
/// thousandth is less than a step.
pub(super) struct Ratios {
    /// Leading zeros of the greatest sum.
    zeros: u32,
    /// `m / J^2`, 16 bits.
    factor: u32,
    /// Bits that are cut from a product of a sum and the factor.
    down: u32,
}

impl Ratios {
    /// No sum is above `greatest`.
    pub fn of(m: u32, inertia: u32, greatest: u32) -> Ratios {
        let [m_zeros, j_zeros, zeros] = [m, inertia, greatest].map(|value| (value | 1).leading_zeros());
        let j = (inertia << j_zeros) >> 16;
        // m = (m << m_zeros) 2^-m_zeros, J = j 2^(16 - j_zeros); 2^2 and 2^16 are cut on the way.
        let factor = (m << m_zeros >> 2).checked_div((j * j) >> 16).unwrap_or(0);
        let down = (21 - PRODUCT + zeros + m_zeros).saturating_sub(2 * j_zeros);
        Ratios { zeros, factor, down }
    }

    /// Ratio of a sum in 1/512; saturates.
    pub fn of_sum(&self, sum: u32) -> i16 {
        self.steps(self.short(sum))
    }

    /// Ratio of the length of a vector of sums in 1/512, at most 0.3 % off; saturates. Four turns towards
    /// the axis (CORDIC) take the place of a root.
    pub fn of_vector(&self, [x, y]: [u32; 2]) -> i16 {
        let [x, y] = [x, y].map(|v| self.short((v as i32).unsigned_abs()) as i32);
        let (mut long, mut short) = (x.max(y), x.min(y));
        for turn in 1..=4 {
            (long, short) = (long + (short >> turn), (short - (long >> turn)).abs());
        }
        // The turns have made it 1.1637 times as long.
        self.steps(((long as u32 * 880) >> 10).min(0xffff))
    }

    /// The first 16 bits of a sum.
    fn short(&self, sum: u32) -> u32 {
        (sum << self.zeros) >> 16
    }

    fn steps(&self, length: u32) -> i16 {
        length.wrapping_mul(self.factor).wrapping_shr(self.down).min(i16::MAX as u32) as i16
    }
}
