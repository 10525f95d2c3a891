//! Logarithm of a [`Scaled`].

use super::Scaled;
use super::product::wide;

impl Scaled {
    /// Logarithm to base 2 in 1/1024, rounded to the nearest (at most 0.501 steps off). Zero gives
    /// `i16::MIN`, far below that of any value of the core.
    pub const fn log2(self) -> i32 {
        let (mut mantissa, exponent) = (self.mantissa(), self.exponent());
        if mantissa == 0 {
            return i16::MIN as i32;
        }
        let mut log = exponent as i32 + 31;
        // With the mantissa in [1, 2): the next bit of the logarithm is 1 if its square is at least 2.
        let mut bit = 0;
        while bit < 11 {
            let square = wide(mantissa, mantissa);
            let carry = (square >> 63) as u32;
            mantissa = (square >> (31 + carry)) as u32;
            log = (log << 1) + carry as i32;
            bit += 1;
        }
        (log + 1) >> 1
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn it_is_rounded_to_the_nearest() {
        let mut state = 1u64;
        for round in 0..200_000u32 {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let value = Scaled::from_u64((state >> (round % 64)).max(1)).shifted((round % 17) as i16 - 24);
            let want = value.to_f64().log2() * 1024.0;
            assert!((f64::from(value.log2()) - want).abs() <= 0.501, "{value:?}");
        }
        assert_eq!(Scaled::from_u64(1).log2(), 0);
        assert_eq!(Scaled::from_u64(8).log2(), 3 << 10);
        assert_eq!((Scaled::ZERO.log2(), Scaled::from_u64(1).shifted(40).log2()), (-32768, 40 << 10));
    }
}
