//! The formula: from a code to pressure.

use crate::format::Code;

/// A gain of 1.0 in Q4.12.
pub const UNITY: u16 = 4096;

/// `(difference * gain + 2048) >> 12`, at most 65535, of each taxel beyond its limit. Returns their mask.
///
/// The product of two 16-bit numbers leaves room for rounding, whose two steps need no constant in a
/// register. `PART` is as long as the compiler unrolls; the registers hold no more than these five addresses.
#[inline(never)] // M0+: out of line
pub(crate) fn scale<const PART: usize, const FALLING: bool>(
    codes: &[Code; PART],
    limit: &[u16; PART],
    rest: &[u16; PART],
    gain: &[u16; PART],
    out: &mut [u16; PART],
) -> u32 {
    let taxels = codes.iter().zip(limit).zip(rest.iter().zip(gain)).zip(out);
    let mut bits = 0;
    for (at, (((code, limit), (rest, gain)), out)) in taxels.enumerate() {
        let (code, limit) = (u32::from(code.0), u32::from(*limit));
        if if FALLING { code < limit } else { code > limit } {
            let rest = u32::from(*rest);
            let difference = if FALLING { rest.wrapping_sub(code) } else { code.wrapping_sub(rest) };
            let value = ((difference.wrapping_mul(u32::from(*gain)) >> 11) + 1) >> 1;
            *out = value.min(0xffff) as u16;
            bits |= 1 << at;
        }
    }
    bits
}
