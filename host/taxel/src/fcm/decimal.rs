//! Decimal numbers, kept as written: 0.1 is 1/10 and not the binary fraction next to it.

use std::fmt;

/// Most decimals: products of two such numbers, and sums of thousands, fit into 128 bits.
pub(crate) const MOST_DECIMALS: u32 = 17;

/// The number `digits` * 10^-`decimals`, without trailing zeros.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Decimal {
    /// The number without its point.
    pub digits: i128,
    /// Digits behind the point.
    pub decimals: u32,
}

impl Decimal {
    /// Parses decimal text such as `-0.25`, `1`, `2.5e-3`; none if it is not a number, or has more than 17
    /// decimals or more than 20 digits before the point.
    pub fn parse(text: &str) -> Option<Decimal> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let mut digits: i128 = format!("{whole}{fraction}").parse().ok()?;
        let mut decimals = i32::try_from(fraction.len()).ok()?.checked_sub(exponent)?;
        while digits % 10 == 0 && decimals > 0 {
            (digits, decimals) = (digits / 10, decimals - 1);
        }
        if digits == 0 {
            return Some(Decimal::default());
        }
        if decimals < 0 {
            digits = digits.checked_mul(10i128.checked_pow(decimals.unsigned_abs())?)?;
        }
        let decimals = u32::try_from(decimals.max(0)).ok()?;
        let fits = decimals <= MOST_DECIMALS && digits.unsigned_abs() < 10u128.pow(20 + decimals);
        fits.then_some(Decimal { digits, decimals })
    }

    /// Decimal number with the shortest text that reads back as this float.
    pub fn from_f64(value: f64) -> Option<Decimal> {
        value.is_finite().then(|| Decimal::parse(&value.to_string())).flatten()
    }

    /// The nearest float.
    pub fn to_f64(self) -> f64 {
        // Text is the shortest way to a correctly rounded quotient.
        self.to_string().parse().expect("a decimal number is a float")
    }

    /// True if the number is in -1 ..= 1.
    pub fn is_fraction(self) -> bool {
        self.digits.unsigned_abs() <= 10u128.pow(self.decimals)
    }

    /// The number in units of 1 / `one`, rounded to nearest, halves away from zero.
    pub fn scaled(self, one: i128) -> i128 {
        let unit = 10i128.pow(self.decimals);
        let twice = 2 * self.digits * one + self.digits.signum() * unit;
        twice / (2 * unit)
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = 10u128.pow(self.decimals);
        let size = self.digits.unsigned_abs();
        write!(f, "{}{}", if self.digits < 0 { "-" } else { "" }, size / unit)?;
        let width = self.decimals as usize;
        if width > 0 { write!(f, ".{:0width$}", size % unit) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_kept() {
        for (text, digits, decimals) in [
            ("0.1", 1, 1),
            ("-0.30", -3, 1),
            ("1", 1, 0),
            ("1.0", 1, 0),
            ("2.5e-3", 25, 4),
            ("1E2", 100, 0),
            ("-0.0", 0, 0),
        ] {
            assert_eq!(Decimal::parse(text), Some(Decimal { digits, decimals }), "{text}");
        }
        for text in ["", "x", "1e-30", "NaN", "1e400", "0.1234567890123456789"] {
            assert_eq!(Decimal::parse(text), None, "{text}");
        }
        assert_eq!(Decimal::from_f64(0.1), Decimal::parse("0.1"));
        assert_eq!(Decimal::from_f64(f64::NAN), None);
    }

    #[test]
    fn scaled_is_rounded_to_nearest() {
        let d = |text| Decimal::parse(text).unwrap();
        assert_eq!((d("0.3").scaled(32768), d("-0.3").scaled(32768)), (9830, -9830));
        assert_eq!((d("0.5").scaled(1), d("-0.5").scaled(1), d("0.25").scaled(100)), (1, -1, 25));
        assert_eq!(d("-0.05").to_string(), "-0.05");
        assert_eq!(d("0.1").to_f64(), 0.1);
    }
}
