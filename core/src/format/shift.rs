//! Shifts of wide numbers, for a machine with 32-bit registers, on which the library's shifts are calls of 30
//! cycles.

use super::machine::WIDE;

/// `value << by`, for `by` below 64.
pub(crate) const fn left(value: u64, by: u32) -> u64 {
    if WIDE { value << by } else { left_by_halves(value, by) }
}

const fn left_by_halves(value: u64, by: u32) -> u64 {
    let (high, low) = ((value >> 32) as u32, value as u32);
    let (high, low) = match by {
        32.. => (low << (by - 32), 0),
        _ => (high << by | low >> 1 >> (31 - by), low << by),
    };
    (high as u64) << 32 | low as u64
}

/// `value >> by`, for `by` below 64.
pub(crate) const fn right(value: u64, by: u32) -> u64 {
    if WIDE { value >> by } else { right_by_halves(value, by) }
}

const fn right_by_halves(value: u64, by: u32) -> u64 {
    let (high, low) = ((value >> 32) as u32, value as u32);
    match by {
        32.. => (high >> (by - 32)) as u64,
        _ => ((high >> by) as u64) << 32 | (low >> by | high << 1 << (31 - by)) as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifts_are_those_of_the_language() {
        for value in [0, 1, u64::MAX, 0x8000_0000, 0x1_0000_0000, 0xdead_beef_cafe_f00d, 1 << 63] {
            for by in 0..64 {
                assert_eq!(
                    [left(value, by), left_by_halves(value, by)],
                    [value << by; 2],
                    "{value:#x} << {by}"
                );
                assert_eq!(
                    [right(value, by), right_by_halves(value, by)],
                    [value >> by; 2],
                    "{value:#x} >> {by}"
                );
            }
        }
    }
}
