//! Real numbers of 60 digits, as integers in units of 2^-200.

use num_bigint::{BigInt, BigUint};
use std::ops::{Add, Div, Mul, Neg, Sub};

const BITS: u32 = 200;

/// A number, cut to a multiple of 2^-200 after every operation: 6e-61.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Real(BigInt);

impl Real {
    /// The quotient of two integers.
    pub fn ratio(part: impl Into<BigInt>, whole: impl Into<BigInt>) -> Real {
        Real((part.into() << BITS) / whole.into())
    }

    pub fn whole(value: impl Into<BigInt>) -> Real {
        Real(value.into() << BITS)
    }

    /// Of a number that is not negative.
    pub fn sqrt(&self) -> Real {
        Real((&self.0 << BITS).sqrt())
    }

    pub fn abs(&self) -> Real {
        Real(BigUint::into(self.0.magnitude().clone()))
    }

    pub fn is_negative(&self) -> bool {
        self.0 < BigInt::ZERO
    }

    /// By the series, after the argument was halved eight times.
    pub fn exp(&self) -> Real {
        const HALVINGS: u32 = 8;
        let one = BigInt::from(1) << BITS;
        let x = &self.0 >> HALVINGS;
        let (mut sum, mut term) = (one.clone(), one);
        for n in 1u32.. {
            term = ((term * &x) >> BITS) / n;
            if term == BigInt::ZERO || term == BigInt::from(-1) {
                break;
            }
            sum += &term;
        }
        for _ in 0..HALVINGS {
            sum = (&sum * &sum) >> BITS;
        }
        Real(sum)
    }

    /// 1 / (1 + exp(-x))
    pub fn logistic(&self) -> Real {
        Real::whole(1) / (Real::whole(1) + (-self).exp())
    }

    pub fn tanh(&self) -> Real {
        Real::whole(2) * (Real::whole(2) * self.clone()).logistic() - Real::whole(1)
    }

    /// Half the angle of the point (x, y), in (-pi/2, pi/2]: half of atan2(y, x), by tan(a / 2) = y / (r + x).
    pub fn half_angle(y: i128, x: i128) -> Real {
        let square = BigInt::from(x) * x + BigInt::from(y) * y;
        let radius = Real((square << (2 * BITS)).sqrt());
        if y == 0 {
            return if x < 0 { pi() / Real::whole(2) } else { Real::whole(0) };
        }
        let down = radius + Real::whole(x);
        let size = Real::whole(y.unsigned_abs());
        let angle =
            if size > down { pi() / Real::whole(2) - (down / size).atan() } else { (size / down).atan() };
        if y < 0 { -&angle } else { angle }
    }

    /// Of a number in 0 ..= 1, by the series, after the angle was halved three times.
    fn atan(&self) -> Real {
        const HALVINGS: u32 = 3;
        let one = Real::whole(1);
        let mut t = self.clone();
        for _ in 0..HALVINGS {
            t = t.clone() / (one.clone() + (one.clone() + t.clone() * t).sqrt());
        }
        let square = (&t.0 * &t.0) >> BITS;
        let (mut sum, mut power) = (BigInt::ZERO, t.0);
        for n in 0u32.. {
            let term = &power / (2 * n + 1);
            if term == BigInt::ZERO {
                break;
            }
            sum = if n % 2 == 0 { sum + term } else { sum - term };
            power = (power * &square) >> BITS;
        }
        Real(sum << HALVINGS)
    }

    /// The nearest float, to 2^-52 of its value, and 2^-1000 at least.
    pub fn to_f64(&self) -> f64 {
        let bits = self.0.bits();
        let cut = bits.saturating_sub(60);
        let top = i64::try_from(&self.0 >> cut).expect("60 bits");
        top as f64 * 2f64.powi(cut as i32 - BITS as i32)
    }
}

/// 4 atan(1)
pub fn pi() -> Real {
    static PI: std::sync::OnceLock<Real> = std::sync::OnceLock::new();
    PI.get_or_init(|| Real::whole(4) * Real::whole(1).atan()).clone()
}

impl Add for Real {
    type Output = Real;

    fn add(self, other: Real) -> Real {
        Real(self.0 + other.0)
    }
}

impl Sub for Real {
    type Output = Real;

    fn sub(self, other: Real) -> Real {
        Real(self.0 - other.0)
    }
}

impl Mul for Real {
    type Output = Real;

    fn mul(self, other: Real) -> Real {
        Real((self.0 * other.0) >> BITS)
    }
}

impl Div for Real {
    type Output = Real;

    fn div(self, other: Real) -> Real {
        Real((self.0 << BITS) / other.0)
    }
}

impl Neg for &Real {
    type Output = Real;

    fn neg(self) -> Real {
        Real(-&self.0)
    }
}

/// Known digits, from handbooks: the reference itself has to be right.
#[test]
fn known_digits() {
    let digits = |value: Real| ((value.0 * BigInt::from(10).pow(50)) >> BITS).to_string();
    assert_eq!(digits(pi()), "314159265358979323846264338327950288419716939937510");
    assert_eq!(digits(Real::whole(1).exp()), "271828182845904523536028747135266249775724709369995");
    assert_eq!(digits(Real::whole(2).sqrt()), "141421356237309504880168872420969807856967187537694");
    assert_eq!(digits(Real::ratio(1, 2).atan()), "46364760900080611621425623146121440202853705428612");
    assert_eq!(digits(Real::whole(1).tanh()), "76159415595576488811945828260479359041276859725793");
    assert_eq!(Real::half_angle(0, -5).to_f64(), std::f64::consts::FRAC_PI_2);
    assert_eq!(Real::half_angle(-3, 0).to_f64(), -std::f64::consts::FRAC_PI_4);
    assert_eq!(Real::ratio(-1, 4).exp().to_f64(), 0.7788007830714049);
}
