//! Quotients and conversions of `format`: exact or rounded to the nearest, and total.

use crate::bounds::table::bound;
use crate::random::Noise;
use taxel_core::format::{Fixed16, Inverse, Micros, Q15, Scaled};

#[test]
fn a_ratio_is_rounded_to_nearest() {
    let stated = bound("share, confidence", "a_ratio_is_rounded_to_nearest");
    let mut noise = Noise(5);
    let (mut count, mut worst) = (0, 0f64);
    let mut take = |part: u64, whole: u64| {
        // (have / 2^15 - part / whole) 2^15 whole
        let off = i128::from(Q15::ratio(part, whole).0) * i128::from(whole) - (i128::from(part) << 15);
        let error = off.abs() as f64 / whole as f64 / 32768.0;
        assert!(error <= stated.absolute, "{part} / {whole}: {error:e}");
        worst = worst.max(error);
        count += 1;
    };
    for whole in 1..=600u64 {
        (0..=whole).for_each(|part| take(part, whole));
    }
    for _ in 0..1_000_000 {
        let whole = 1 + (noise.below(1 << 48) << 16 | noise.below(1 << 16)) / (1 << noise.below(63));
        let part = ((u128::from(whole) * u128::from(noise.below(1 << 33))) >> 33) as u64;
        take(part, whole);
        // Next to a half.
        let half = ((u128::from(whole) * (2 * u128::from(noise.below(32768)) + 1)) >> 16) as u64;
        take(half, whole);
        take(half.saturating_add(1).min(whole), whole);
    }
    println!("{count} quotients, largest error {worst:.4e}");
}

#[test]
fn numbers_outside_their_range_saturate() {
    assert_eq!([Q15::ratio(0, 0), Q15::ratio(7, 0)], [Q15(0); 2]);
    assert_eq!([Q15::ratio(8, 7), Q15::ratio(u64::MAX, 1)], [Q15::ONE; 2]);
    let wide = [i64::MIN, -(1 << 31) - 1, -(1 << 31), (1 << 31) - 1, 1 << 31, i64::MAX];
    let ends = [i32::MIN, i32::MIN, i32::MIN, i32::MAX, i32::MAX, i32::MAX];
    assert_eq!(wide.map(Fixed16::saturating), ends.map(Fixed16));
    assert_eq!(Micros(5).since(Micros(6)), 0);
    assert_eq!(Micros(u64::MAX).since(Micros(0)), u64::MAX);
    // 2^32 ms are 49.7 days.
    let ms = |us: u64| Micros(us).millis_since(Micros(0));
    assert_eq!([ms(999), ms(1000), ms(u64::MAX)], [0, 1, u32::MAX]);
    assert_eq!([ms(u64::from(u32::MAX) * 1000 + 999), ms((1 << 32) * 1000)], [u32::MAX; 2]);
    assert_eq!(Inverse::of(0).nearest(-1), i32::MIN);
}

/// Far beyond any number of the core the exponent saturates: no panic, and what is nothing stays nothing.
#[test]
fn soft_floats_are_total() {
    let one = Scaled::from_u64(1);
    let (great, small) = (one.shifted(i16::MAX), one.shifted(i16::MIN));
    let all = [Scaled::ZERO, Scaled::MAX, one, great, small, Scaled::from_u64(u64::MAX)];
    for (a, b) in all.into_iter().flat_map(|a| all.map(|b| (a, b))) {
        for value in [a.times(b), a.over(b), a.times(b).sqrt(), a.over(b).shifted(i16::MIN)] {
            for bits in [i16::MIN, -1, 0, 24, i16::MAX] {
                let (fixed, wide) = (value.to_fixed(bits), value.to_wide(bits));
                assert!(value != Scaled::ZERO || (fixed, wide) == (0, 0));
            }
            assert!(value.to_q15().0 >= 0 && value.to_f64() >= 0.0);
        }
    }
    assert_eq!([great.to_fixed(0), great.to_fixed24().0, small.to_fixed(31)], [u32::MAX, u32::MAX, 0]);
    assert_eq!([great.to_wide(0), small.to_wide(0)], [u64::MAX, 0]);
    assert_eq!(great.to_q15(), Q15(i32::MAX));
}
