//! Integer square root without a divider.

use super::product::wide;
use super::shift::left;

/// The greatest integer whose square is not above `value`. Equals `u64::isqrt`, in a third of its time on a
/// machine without a divider: Newton's iteration for `1 / sqrt(value)`, which needs multiplications only,
/// then an exact correction.
pub const fn root(value: u64) -> u32 {
    if value == 0 {
        return 0;
    }
    if value >> 62 != 0 {
        return exact_root(value);
    }
    let shift = value.leading_zeros() & !1;
    exact_root(left(value, shift)) >> (shift / 2)
}

/// Exact root of a `normal` with bit 63 or 62 set.
const fn exact_root(normal: u64) -> u32 {
    let mut root = normal_root(normal);
    // Corrects an error of at most two units.
    let mut square = wide(root, root);
    while square > normal {
        root -= 1;
        square = wide(root, root);
    }
    while normal - square > 2 * root as u64 {
        square += 2 * root as u64 + 1;
        root += 1;
    }
    root
}

/// Root of a `normal` with bit 63 or 62 set, at most one or two units off.
const fn normal_root(normal: u64) -> u32 {
    // N = normal / 2^64 in [1/4, 1) as Q16, and y, about 1 / sqrt(N), as Q15. The line is at most 9 % off;
    // three rounds of y (3 - N y^2) / 2 in 16 bits leave 2^-13.
    let n = (normal >> 48) as u32;
    let mut y = 69_885 - ((n * 39_934) >> 16);
    let mut round = 0;
    while round < 3 {
        let square = (y * y) >> 16;
        let rest = (3u32 << 30).wrapping_sub(n * square);
        y = (y * (rest >> 16)) >> 15;
        y = if y > 0xffff { 0xffff } else { y };
        round += 1;
    }
    // sqrt(normal) = 2^32 N y; then twice r + (normal - r^2) / (2 r), where 1 / (2 r) = y / 2^33: leaves
    // 2^-25, then the unit.
    let top = (normal >> 32) as u32;
    let sum = (((top >> 16) * y) as u64 + (((top & 0xffff) * y) >> 16) as u64) << 1;
    let root = if sum > u32::MAX as u64 { u32::MAX } else { sum as u32 };
    let rest = normal.wrapping_sub(wide(root, root)) as i64;
    let root = root.saturating_add_signed(scaled((rest >> 22) as i32, y) >> 10);
    let rest = normal.wrapping_sub(wide(root, root)) as i64;
    root.saturating_add_signed(scaled((rest >> 12) as i32, y) >> 20)
}

/// `value * y / 2^16`, for a `y` of 16 bits.
const fn scaled(value: i32, y: u32) -> i32 {
    (value >> 16) * y as i32 + (((value & 0xffff) as u32 * y) >> 16) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_integer_square_root() {
        let mut state = 1u64;
        for round in 0..1_000_000u32 {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let value = (state ^ (state >> 29)) >> (round % 64);
            assert_eq!(u64::from(root(value)), value.isqrt(), "{value}");
            // Squares and their neighbours.
            let square = value.isqrt().pow(2);
            for value in [square, square.saturating_sub(1), square.saturating_add(1)] {
                assert_eq!(u64::from(root(value)), value.isqrt(), "{value}");
            }
        }
        for value in (0..70_000).chain((0..64).map(|bit| u64::MAX >> bit)).chain((0..64).map(|bit| 1 << bit))
        {
            assert_eq!(u64::from(root(value)), value.isqrt(), "{value}");
        }
    }
}
