//! Codes to pressure: the taxels beyond their limit, and only those.

use super::rows::{Rows, grain};
use super::slices::{panel_mut, panel_of};
use super::state::ConditionState;
use super::terms::Terms;
use crate::format::Code;
use crate::garment::Area;

/// Taxels that are looked at together.
const CHUNK: usize = 16;

impl<const TAXELS: usize> ConditionState<TAXELS> {
    /// Calibrates a panel whose calibrated image is empty; whether anything is left.
    pub(super) fn calibrate(&mut self, area: &Area, codes: &[Code], terms: Terms) -> bool {
        let limit = panel_of(&self.limit, area);
        let codes = panel_of(codes, area);
        let there = limit.len().min(codes.len());
        let panel = Panel {
            codes: codes.get(..there).unwrap_or(codes),
            limit: limit.get(..there).unwrap_or(limit),
            rest: panel_of(&self.baseline, area),
            gain: panel_of(&self.gain, area),
            out: panel_mut(&mut self.calibrated, area),
        };
        let marks = Marks {
            rows: &mut self.rows,
            row: area.first_row,
            start: 0,
            columns: usize::from(area.columns),
            grain: grain(area),
        };
        let least = (u32::from(terms.floor) << 12) - 2048;
        if terms.falling {
            panel.calibrate::<true>(least, marks)
        } else {
            panel.calibrate::<false>(least, marks)
        }
    }
}

/// The taxels of a panel.
struct Panel<'a> {
    codes: &'a [Code],
    limit: &'a [u16],
    rest: &'a [u16],
    gain: &'a [u16],
    out: &'a mut [u16],
}

impl Panel<'_> {
    fn calibrate<const FALLING: bool>(mut self, least: u32, mut marks: Marks<'_>) -> bool {
        let whole = self.codes.len() / CHUNK * CHUNK;
        let any = self.chunks::<CHUNK, FALLING>(0, least, &mut marks);
        self.chunks::<1, FALLING>(whole, least, &mut marks) | any
    }

    /// All from `first` on that N divides: what is quiet is skipped, then all is calibrated until something is quiet again.
    fn chunks<const N: usize, const FALLING: bool>(
        &mut self,
        first: usize,
        least: u32,
        marks: &mut Marks<'_>,
    ) -> bool {
        let (codes, _) = self.codes.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (limit, _) = self.limit.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (rest, _) = self.rest.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (gain, _) = self.gain.get(first..).unwrap_or(&[]).as_chunks::<N>();
        let (out, _) = self.out.get_mut(first..).unwrap_or(&mut []).as_chunks_mut::<N>();
        let mut any = false;
        let mut at = 0;
        while let (Some(codes), Some(limit)) = (codes.get(at..), limit.get(at..)) {
            let skipped = quiet::<N, FALLING>(codes, limit);
            at += skipped;
            let (Some(codes), Some(rest)) = (codes.get(skipped..), rest.get(at..)) else { break };
            let (Some(gain), Some(out)) = (gain.get(at..), out.get_mut(at..)) else { break };
            if codes.is_empty() {
                break;
            }
            at += loud::<N, FALLING>(codes, rest, gain, out, least, first + at * N, marks);
            any = true;
        }
        any
    }
}

/// How many chunks hold nothing beyond a limit.
///
/// Without a branch per taxel (one is negative, then all are), and not inlined, so that the loop has the registers of a
/// Cortex-M0+ to itself.
#[inline(never)]
fn quiet<const N: usize, const FALLING: bool>(codes: &[[Code; N]], limit: &[[u16; N]]) -> usize {
    let loud = |(codes, limit): (&[Code; N], &[u16; N])| {
        let over = codes.iter().zip(limit).map(|(code, limit)| {
            let (code, limit) = (i32::from(code.0), i32::from(*limit));
            if FALLING { code - limit } else { limit - code }
        });
        over.fold(0, |all, one| all | one) < 0
    };
    codes.iter().zip(limit).position(loud).unwrap_or(codes.len())
}

/// Calibrates until a chunk is quiet; how many there were.
#[inline(never)]
fn loud<const N: usize, const FALLING: bool>(
    codes: &[[Code; N]],
    rest: &[[u16; N]],
    gain: &[[u16; N]],
    out: &mut [[u16; N]],
    least: u32,
    mut at: usize,
    marks: &mut Marks<'_>,
) -> usize {
    let mut done = 0;
    let mut more = [0; N];
    for (((codes, rest), gain), out) in codes.iter().zip(rest).zip(gain).zip(out) {
        differences::<N, FALLING>(codes, rest, &mut more);
        let bits = scale(&more, gain, out, least);
        done += 1;
        if bits == 0 {
            break;
        }
        marks.mark(at, N, bits);
        at += N;
    }
    done
}

/// What the codes have more than at rest, or less.
///
/// Apart from [`scale`] and not inlined, as that: neither needs more than the registers of a Cortex-M0+.
#[inline(never)]
fn differences<const N: usize, const FALLING: bool>(codes: &[Code; N], rest: &[u16; N], more: &mut [i32; N]) {
    for ((more, code), rest) in more.iter_mut().zip(codes).zip(rest) {
        let (code, rest) = (i32::from(code.0), i32::from(*rest));
        *more = if FALLING { rest - code } else { code - rest };
    }
}

/// `(difference * gain + 2048) >> 12`, at most 65535, where that reaches the floor; a bit for each such taxel.
///
/// The product of two 16-bit numbers leaves room for the rounding. It is compared before that, with the least that comes to the
/// floor, and the two steps of the rounding need no constant in a register.
#[inline(never)]
fn scale<const N: usize>(differences: &[i32; N], gain: &[u16; N], out: &mut [u16; N], least: u32) -> u32 {
    let mut bits = 0;
    for (bit, ((difference, gain), out)) in differences.iter().zip(gain).zip(out).enumerate() {
        let product = difference.cast_unsigned().wrapping_mul(u32::from(*gain));
        if *difference > 0 && product >= least {
            let value = ((product >> 11) + 1) >> 1;
            *out = value.min(0xffff) as u16;
            bits |= 1 << bit;
        }
    }
    bits
}

/// Takes down where something is; goes through a panel once, row by row.
struct Marks<'a> {
    rows: &'a mut Rows,
    /// Over all panels.
    row: u16,
    /// Its first taxel in the panel.
    start: usize,
    columns: usize,
    grain: u32,
}

impl Marks<'_> {
    /// Taxels of the panel from number `at` on, `count` of them, a bit for each that holds something.
    fn mark(&mut self, at: usize, count: usize, bits: u32) {
        let mut column = at - self.start;
        while column >= self.columns {
            self.next_row();
            column -= self.columns;
        }
        if column + count <= self.columns && self.grain == 0 {
            return self.rows.add(self.row, (bits << column) as u16);
        }
        for bit in 0..count {
            if column >= self.columns {
                self.next_row();
                column = 0;
            }
            if bits >> bit & 1 == 1 {
                self.rows.add(self.row, 1 << (column >> self.grain));
            }
            column += 1;
        }
    }

    fn next_row(&mut self) {
        self.row = self.row.saturating_add(1);
        self.start += self.columns;
    }
}
