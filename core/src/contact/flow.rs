//! How far a pattern of pressure has moved between two small pictures: least squares over temporal change and spatial
//! slope (Lucas and Kanade 1981), in integers.
//!
//! Slopes are taken over three taxels and smoothed across with 1 4 1; the change is smoothed with 1 4 1 both ways. The
//! quotient of the two is that of the fourth-order compact difference scheme: for a wave of six taxels 1 % off, where plain
//! central differences are 17 % off. Both pictures share the slope, so that there and back are the same way.

use crate::format::Inverse;

/// Rows and columns of a picture, at most.
pub(super) const SIDE: usize = 12;

/// Two pictures of the same size, and which taxels of them count.
pub(super) struct Pictures<'a> {
    pub before: &'a [[u16; SIDE]; SIDE],
    /// Rows of the later one; as wide as `columns`, or nothing is found.
    pub now: [&'a [u16]; SIDE],
    pub rows: usize,
    pub columns: usize,
    /// Bits of the columns that count, row by row; never at the border of the picture.
    pub inner: &'a [u16; SIDE],
    /// Greatest pressure in either.
    pub peak: u16,
}

/// What the pictures say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flow {
    /// The later is the earlier, moved by so much along x and y, in 2^-16 taxel; at most two taxels.
    Moved([i32; 2]),
    /// There is no pattern.
    Flat,
    /// There is one, but what changed is not its place.
    Changed,
}

/// One taxel of both pictures, seen along its row.
#[derive(Debug, Default, Clone, Copy)]
struct Smooth {
    /// Of the sum of both, over two taxels.
    slope: i32,
    /// Of both, smoothed.
    sum: i32,
    /// From the earlier to the later, smoothed.
    change: i32,
}

type Line = [Smooth; SIDE];

/// Sums over the taxels that count: slopes x and y in 24ths of 2^scale counts per taxel (13 bits), change t in 18ths (14
/// bits). With 100 taxels none exceeds 31 bits.
#[derive(Debug, Default)]
struct Sums {
    count: u32,
    x: i32,
    y: i32,
    t: i32,
    xx: i32,
    xy: i32,
    yy: i32,
    xt: i32,
    yt: i32,
    tt: i32,
}

/// Mean square of the slope, in the units of [`Sums`], below which there is no pattern: a third of 1/128 of the
/// peak per taxel.
const FLAT: u32 = 64;

impl Flow {
    /// Compares the pictures. Along a direction in which there is no pattern, as along a ridge, the way is `expected`.
    pub fn of(pictures: &Pictures, expected: [i32; 2]) -> Flow {
        match Sums::of(pictures) {
            Some(sums) => sums.solve(expected),
            None => Flow::Changed,
        }
    }
}

impl Sums {
    /// None where a row is missing.
    fn of(pictures: &Pictures) -> Option<Sums> {
        // Eight significant bits: what is beyond them is below the noise of any taxel.
        let scale = (16 - pictures.peak.leading_zeros()).saturating_sub(8);
        let mut sums = Sums::default();
        let mut lines = [Line::default(); 3];
        let [above, here, below] = &mut lines;
        let (mut above, mut here, mut below) = (above, here, below);
        let mut marked = 0;
        let lines = pictures.before.iter().zip(pictures.now).zip(pictures.inner);
        for ((before, now), inner) in lines.take(pictures.rows) {
            let before = before.get(..pictures.columns).filter(|before| before.len() == now.len())?;
            smooth(before, now, below);
            sums.take(above, here, below, marked, scale);
            marked = *inner;
            (above, here, below) = (here, below, above);
        }
        Some(sums)
    }

    /// Adds the marked taxels of the middle line.
    fn take(&mut self, above: &Line, here: &Line, below: &Line, mut marked: u16, scale: u32) {
        let half = 1 << scale >> 1;
        for ((above, here), below) in above.iter().zip(here).zip(below) {
            if marked & 1 == 1 {
                let x = (above.slope + 4 * here.slope + below.slope + half) >> scale;
                let y = (below.sum - above.sum + half) >> scale;
                let t = (above.change + 4 * here.change + below.change + 2 * half) >> scale >> 1;
                self.count += 1;
                self.x += x;
                self.y += y;
                self.t += t;
                self.xx = self.xx.wrapping_add(x.wrapping_mul(x));
                self.xy = self.xy.wrapping_add(x.wrapping_mul(y));
                self.yy = self.yy.wrapping_add(y.wrapping_mul(y));
                self.xt = self.xt.wrapping_add(x.wrapping_mul(t));
                self.yt = self.yt.wrapping_add(y.wrapping_mul(t));
                self.tt = self.tt.wrapping_add(t.wrapping_mul(t));
            }
            marked >>= 1;
            if marked == 0 {
                return;
            }
        }
    }

    /// A change that is the same everywhere is pressure, not motion: sums about the means.
    fn centre(&mut self) {
        let count = Inverse::of(self.count);
        let [x, y, t] = [self.x, self.y, self.t].map(|sum| count.nearest(sum.into()));
        self.xx = self.xx.wrapping_sub(x.wrapping_mul(self.x));
        self.xy = self.xy.wrapping_sub(x.wrapping_mul(self.y));
        self.yy = self.yy.wrapping_sub(y.wrapping_mul(self.y));
        self.xt = self.xt.wrapping_sub(x.wrapping_mul(self.t));
        self.yt = self.yt.wrapping_sub(y.wrapping_mul(self.t));
        self.tt = self.tt.wrapping_sub(t.wrapping_mul(self.t));
    }

    /// `w` of `t = w (x, y)` by least squares; the way is `-4/3 w`.
    fn solve(mut self, expected: [i32; 2]) -> Flow {
        self.centre();
        let energy = (self.xx.max(0) as u32).saturating_add(self.yy.max(0) as u32);
        // Sums that wrapped: something else, of more than the peak, has come into the picture.
        if self.xx.min(self.yy) < 0 || self.xy.unsigned_abs() > energy {
            return Flow::Changed;
        }
        if energy < FLAT * self.count {
            return Flow::Flat;
        }
        // Fourteen bits for the sum of xx and yy, so that all products fit in 31.
        let down = (32 - energy.leading_zeros()).saturating_sub(14);
        let [xx, xy, yy, xt, yt, tt] =
            [self.xx, self.xy, self.yy, self.xt, self.yt, self.tt].map(|sum| sum >> down);
        let energy = xx + yy;
        if energy == 0 || xt.unsigned_abs().max(yt.unsigned_abs()) > 2 * energy as u32 {
            return Flow::Changed;
        }
        let left = |w: [i32; 2]| tt.saturating_sub((w[0] * xt + w[1] * yt) >> 12).max(0);
        let determinant = xx * yy - xy * xy;
        // The standard deviation of w along a direction is that of what is left, over the root of the slope's energy there.
        let clear = |energy: i32, w: [i32; 2]| {
            i64::from(energy) * i64::from(self.count) >= i64::from(left(w)) * CLEAR
        };
        let per_energy = Inverse::of(energy as u32);
        let mut w = None;
        if determinant >= (energy * energy) >> 6 {
            let inverse = Inverse::of(determinant as u32);
            let all = [yy * xt - xy * yt, xx * yt - xy * xt].map(|n| inverse.nearest(i64::from(n) << 12));
            let weaker = per_energy.nearest(determinant.into());
            w = (all.iter().all(|w| w.abs() <= LONGEST) && clear(weaker, all)).then_some(all);
        }
        let w = w.unwrap_or_else(|| {
            // What is expected, corrected where there is a slope.
            let e = expected.map(|way| -((way.clamp(-2 << 16, 2 << 16) * 3) >> 6));
            let correct = |e, x, y, t: i32| e + per_energy.nearest(i64::from((t << 12) - x - y));
            [correct(e[0], xx * e[0], xy * e[1], xt), correct(e[1], xy * e[0], yy * e[1], yt)]
        });
        if w.iter().any(|w| w.abs() > LONGEST) || !clear(energy, w) {
            return Flow::Changed;
        }
        // What is left must be less than half a taxel of displacement would leave.
        if left(w) > energy >> 3 {
            return Flow::Changed;
        }
        Flow::Moved(w.map(|w| -(w << 6) / 3))
    }
}

/// Two taxels, in w.
const LONGEST: i32 = 3 << 11;

/// The standard deviation that is allowed: a tenth of a taxel, which is 1/14 in w, and its square 1/196.
const CLEAR: i64 = 196;

/// Sums, slopes and changes along one row; the first and the last taxel have none.
fn smooth(before: &[u16], now: &[u16], out: &mut Line) {
    let both = |(before, now): (&u16, &u16)| {
        let (before, now) = (i32::from(*before), i32::from(*now));
        (before + now, now - before)
    };
    let mut columns = before.iter().zip(now).map(both);
    let (Some(mut left), Some(mut here)) = (columns.next(), columns.next()) else { return };
    for (out, right) in out.iter_mut().skip(1).zip(columns) {
        *out = Smooth {
            slope: right.0 - left.0,
            sum: left.0 + 4 * here.0 + right.0,
            change: left.1 + 4 * here.1 + right.1,
        };
        (left, here) = (here, right);
    }
}
