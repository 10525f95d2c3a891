//! Stateless noise from a hash, so that a sample's noise does not depend on other samples.

/// Standard deviation of [`unit_noise`]: four uniform 16-bit numbers, `sqrt(4 / 12) 2^16`.
pub(super) const UNIT_NOISE_RMS: f32 = 37_837.2;

/// Bell-shaped noise from a hash of a taxel's key and the time: the sum of four 16-bit parts, mean 0, at most
/// 3.5 times its standard deviation.
#[inline]
pub(super) fn unit_noise(key: u64, t_ns: u64) -> f32 {
    let mix = |a: u64, b: u64| {
        let product = u128::from(a) * u128::from(b);
        (product >> 64) as u64 ^ product as u64
    };
    let hash = mix(mix(t_ns ^ 0x9e37_79b9_7f4a_7c15, key), 0xd6e8_feb8_6659_fd93);
    let pairs = (hash & 0xffff_0000_ffff) + (hash >> 16 & 0xffff_0000_ffff);
    let sum = (pairs & 0xffff_ffff) + (pairs >> 32);
    sum as i32 as f32 - 131_070.0
}
