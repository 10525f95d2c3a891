//! Codes to pressure with unity gains by SIMD: sixteen taxels at once.

use super::marks::Marks;
use super::panel::PanelCodes;
use crate::format::Code;
use crate::image::row16::{ROW16, Row16};
use bytemuck::must_cast;
use wide::u16x16;

impl PanelCodes<'_> {
    /// Calibrates whole rows of a multiple of sixteen columns, where a code is `margin` further from its
    /// baseline than from its limit. Returns true if any taxel is active.
    pub fn calibrate_rows<const FALLING: bool>(&mut self, marks: &mut Marks<'_>, margin: u16) -> bool {
        let (codes, limits) = (self.codes.as_chunks().0, self.limit.as_chunks().0);
        let out = self.out.as_chunks_mut().0;
        let row = marks.chunks16().max(1);
        let rows = codes.chunks(row).zip(limits.chunks(row)).zip(out.chunks_mut(row));
        let mut any = false;
        for (row, ((codes, limits), out)) in rows.enumerate() {
            let mut groups = 0;
            for (at, ((codes, limits), out)) in (0..).zip(codes.iter().zip(limits).zip(out)) {
                let bits = exceed::<FALLING>(codes, limits, out, margin);
                if bits != 0 {
                    groups |= marks.groups_of_chunk16(at, bits);
                }
            }
            if groups != 0 {
                marks.mark_row(row, groups);
                any = true;
            }
        }
        any
    }
}

/// Stores the values of sixteen taxels, 0 for inactive ones, and returns the mask of active ones. Writes
/// nothing if none is active.
#[inline(always)]
fn exceed<const FALLING: bool>(codes: &[Code; ROW16], limits: &Row16, out: &mut Row16, margin: u16) -> u32 {
    let (codes, limits) = (u16x16::new(must_cast(*codes)), u16x16::new(*limits));
    let beyond = if FALLING { limits.saturating_sub(codes) } else { codes.saturating_sub(limits) };
    let active = !beyond.simd_eq(u16x16::ZERO);
    let bits = active.to_bitmask();
    if bits != 0 {
        *out = (active & (beyond + u16x16::splat(margin))).to_array();
    }
    bits
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::garment::{Garment, Layout};
    use crate::image::rows::Rows;
    use std::vec;
    use std::vec::Vec;

    /// Rows of one chunk of sixteen and of several, compared with the portable kernel.
    #[test]
    fn rows_are_calibrated_as_their_chunks() {
        let mut noise = 1u32;
        let mut next = |end: u32| {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            (noise >> 16) % end
        };
        let mut found = 0;
        for (round, columns) in
            (0..40).flat_map(|round| [16, 32, 48, 64, 256].map(|columns| (round, columns)))
        {
            let layout = Layout::build(&Garment::recorded(12, columns), 3072, 255).unwrap();
            let area = &layout.areas()[0];
            // At both ends of the scale; few codes are beyond their limits, or most.
            let margin = [1, 60, 4000][round % 3];
            let (codes, limit): (Vec<Code>, Vec<u16>) = (0..layout.taxels())
                .map(|_| {
                    let limit = [margin, 700, 0x8000, u16::MAX - margin][next(4) as usize];
                    let more =
                        if next(100) < [3, 80][round % 2] { next(u32::from(margin) + 1) as i32 } else { 0 };
                    let code = i32::from(limit) + if round % 4 < 2 { more } else { -more };
                    (Code(code as u16), limit)
                })
                .unzip();
            let calibrated = |chunks: bool| {
                let mut out = vec![0; codes.len()];
                let mut rows = Rows::NONE;
                let mut marks = Marks::of(&mut rows, area);
                let mut panel =
                    PanelCodes { codes: &codes, limit: &limit, rest: &limit, gain: &limit, out: &mut out };
                let any = match (chunks, round % 4 < 2) {
                    (false, true) => panel.calibrate_rows::<false>(&mut marks, margin),
                    (false, false) => panel.calibrate_rows::<true>(&mut marks, margin),
                    (true, true) => panel.calibrate_chunks::<false>(&mut marks, Some(margin)),
                    (true, false) => panel.calibrate_chunks::<true>(&mut marks, Some(margin)),
                };
                (any, rows, out)
            };
            let (rows, chunks) = (calibrated(false), calibrated(true));
            assert!(rows == chunks, "{columns}");
            found += usize::from(rows.0);
        }
        assert!(found > 150, "{found} of 200");
    }
}
