//! Sums over the taxels of a run: each presses with its value, against its normal.
//!
//! The filter cuts the crest of a touch down to its neighbours where it cannot be told from an impulse. What
//! it cuts from a crest is part of the force: a taxel counts with its value before the filter, unless that
//! exceeds the filtered one by more than noise, which an impulse does.

use super::taxel::TaxelRecord;
use crate::filter::points::MARGIN;
use crate::segment::bits::WORD;

/// Greatest value of which [`TOGETHER`] products fit in 31 bits: 4095 * 2^15 * 16 < 2^31.
const COMMON: u16 = 4095;
/// Taxels whose products are added in 32 bits.
const TOGETHER: usize = 16;

/// Adds `value * normal` of each taxel to `force` and `value * arm` to `moment`, in units of 2^-14 counts and
/// 2^-14 counts m, and returns the sum of the values. Of `taxels`, bit `i` stands for value `i`, of at most
/// [`WORD`]; the values are those before and after the filter.
#[inline(never)] // M0+: out of line
pub(super) fn press(
    (calibrated, filtered): (&[u16], &[u16]),
    mut taxels: u32,
    records: &[TaxelRecord],
    (force, moment): (&mut [i64; 3], &mut [i64; 3]),
) -> u32 {
    let mut room = [0; WORD as usize];
    let (mut total, mut all) = (0u32, 0);
    for ((to, before), after) in room.iter_mut().zip(calibrated).zip(filtered) {
        if taxels & 1 == 1 {
            *to = pressure(*before, *after);
            total = total.wrapping_add((*to).into());
            all |= *to;
        }
        taxels >>= 1;
    }
    let together = if all <= COMMON { TOGETHER } else { 1 };
    let (mut values, mut records) = (room.get(..records.len()).unwrap_or(&room), records);
    while !values.is_empty() {
        let now = together.min(values.len());
        let (these, later) = values.split_at_checked(now).unwrap_or((values, &[]));
        let (their, beyond) = records.split_at_checked(now).unwrap_or((records, &[]));
        add(force, sum::<NORMAL>(these, their));
        add(moment, sum::<ARM>(these, their));
        (values, records) = (later, beyond);
    }
    total
}

/// Pressure of a taxel, from its values before and after the filter.
fn pressure(before: u16, after: u16) -> u16 {
    let most = after.saturating_add(after / 16).saturating_add(MARGIN);
    if before <= most { before.max(after) } else { after }
}

/// Which vector of a record is summed.
const NORMAL: bool = false;
const ARM: bool = true;

/// Sum of `value * vector`; modulo 2^32.
#[inline(never)] // M0+: out of line
fn sum<const WHICH: bool>(values: &[u16], records: &[TaxelRecord]) -> [i32; 3] {
    let [mut x, mut y, mut z] = [0i32; 3];
    for (value, record) in values.iter().zip(records) {
        let [a, b, c] = if WHICH { record.arm } else { record.normal };
        let value = i32::from(*value);
        x = x.wrapping_add(value * i32::from(a));
        y = y.wrapping_add(value * i32::from(b));
        z = z.wrapping_add(value * i32::from(c));
    }
    [x, y, z]
}

fn add(to: &mut [i64; 3], more: [i32; 3]) {
    for (to, more) in to.iter_mut().zip(more) {
        *to = to.wrapping_add(more.into());
    }
}
