//! Slopes of two small pictures, and the change between them, row by row.
//!
//! Each loop is a function of its own that reads the output of the one before, so that its values fit in the
//! registers of a Cortex-M0+.

/// Greatest number of rows and columns of a picture.
pub(crate) const SIDE: usize = 12;

/// One column of both pictures, over three rows.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct Smooth {
    /// Sum of both pictures, smoothed.
    sum: i32,
    /// Difference of the row below and the row above, of both pictures together.
    slope: i32,
    /// Later picture minus earlier one, smoothed.
    change: i32,
}

/// A row of columns.
pub(crate) type SmoothRow = [Smooth; SIDE];

/// Slopes x and y in 24ths of 2^scale counts per taxel and change t in 18ths, for the taxels of a line
/// without the first and the last.
pub(crate) type SlopeTerms = [[i32; 3]; SIDE - 2];

/// Computes sums, slopes and changes of the middle one of three rows.
#[inline(never)]
pub(crate) fn smooth(before: &[[u16; SIDE]; 3], now: &[&[u16]; 3], out: &mut SmoothRow) {
    let [above, here, below] = before;
    let before = above.iter().zip(here).zip(below);
    let [above, here, below] = *now;
    let now = above.iter().zip(here).zip(below);
    let three = |((above, here), below): ((&u16, &u16), &u16)| [*above, *here, *below].map(i32::from);
    for (out, (before, now)) in out.iter_mut().zip(before.zip(now)) {
        let ([a, h, b], [above, here, below]) = (three(before), three(now));
        // Smoothed columns of both pictures: their sum, and the later minus the earlier.
        let (was, is) = (a + 4 * h + b, above + 4 * here + below);
        *out = Smooth { sum: was + is, slope: b - a + below - above, change: is - was };
    }
}

/// Computes the terms of the marked taxels of a line, never the first or the last; all others are 0.
pub(crate) fn differentiate(line: &SmoothRow, marked: u16, scale: u32, out: &mut SlopeTerms) {
    let half = 1 << scale >> 1;
    across(line, scale, half, out);
    along(line, scale, half, out);
    change(line, scale + 1, 2 * half, out);
    for (terms, at) in out.iter_mut().zip(1..) {
        if marked >> at & 1 == 0 {
            *terms = [0; 3];
        }
    }
}

/// Slopes along x.
#[inline(never)]
fn across(line: &SmoothRow, scale: u32, half: i32, out: &mut SlopeTerms) {
    for ([left, _, right], out) in line.array_windows().zip(out) {
        out[0] = (right.sum - left.sum + half) >> scale;
    }
}

/// Slopes along y.
#[inline(never)]
fn along(line: &SmoothRow, scale: u32, half: i32, out: &mut SlopeTerms) {
    for ([left, here, right], out) in line.array_windows().zip(out) {
        out[1] = (4 * here.slope + left.slope + right.slope + half) >> scale;
    }
}

/// Changes in time.
#[inline(never)]
fn change(line: &SmoothRow, scale: u32, half: i32, out: &mut SlopeTerms) {
    for ([left, here, right], out) in line.array_windows().zip(out) {
        out[2] = (4 * here.change + left.change + right.change + half) >> scale;
    }
}

/// Returns the sums of term A, of its squares, and of its products with term B.
#[inline(never)]
pub(crate) fn products<const A: usize, const B: usize>(terms: &SlopeTerms) -> [i32; 3] {
    let (mut sum, mut square, mut mixed) = (0, 0, 0i32);
    for term in terms {
        let (a, b) = (term[A], term[B]);
        sum += a;
        square = a.wrapping_mul(a).wrapping_add(square);
        mixed = a.wrapping_mul(b).wrapping_add(mixed);
    }
    [sum, square, mixed]
}
