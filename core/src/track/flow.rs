//! Displacement of a pattern of pressure between two small pictures: least squares over temporal change and
//! spatial slope (Lucas and Kanade 1981), in integers.
//!
//! Slopes are taken over three taxels and smoothed across with 1 4 1; the change is smoothed with 1 4 1 both
//! ways. The quotient of the two is that of the fourth-order compact difference scheme: for a wave of six
//! taxels it is 1 % off, plain central differences 17 %. The slope is that of both pictures together, so that
//! the displacement there and back is the same.

use super::gradient::{SIDE, SlopeTerms, SmoothRow, differentiate, products, smooth};
use crate::format::Inverse;

/// Two pictures of one size, and the mask of the taxels to compare.
pub(crate) struct Pictures<'a> {
    pub before: &'a [[u16; SIDE]; SIDE],
    /// Rows of the later picture. Each must have `columns` values; otherwise the result is [`Flow::Changed`].
    pub now: [&'a [u16]; SIDE],
    pub rows: usize,
    pub columns: usize,
    /// Bit mask of the columns to compare, row by row; without the border of the picture.
    pub inner: &'a [u16; SIDE],
    /// Greatest pressure in either picture.
    pub peak: u16,
}

/// Result of the comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Flow {
    /// The pattern has moved by this much along x and y, in 2^-16 taxel; at most two taxels.
    Moved([i32; 2]),
    /// There is no pattern.
    Flat,
    /// There is a pattern, but the change is not a displacement of it.
    Changed,
}

/// Sums over the masked taxels: slopes x and y in 24ths of 2^scale counts per taxel (13 bits), change t in
/// 18ths (14 bits). None exceeds 31 bits, even if all 100 taxels inside the border count.
#[derive(Debug, Default)]
struct FlowSums {
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

/// Mean square of the slope, in the units of [`FlowSums`], below which there is no pattern: a third of 1/128
/// of the peak per taxel.
const FLAT: u32 = 64;

impl Flow {
    /// Compares the pictures. Along a direction without a pattern, for example along a ridge, the result is
    /// `expected`.
    pub fn of(pictures: &Pictures, expected: [i32; 2]) -> Flow {
        match FlowSums::of(pictures) {
            Some(sums) => sums.solve(expected),
            None => Flow::Changed,
        }
    }
}

impl FlowSums {
    /// Returns none if a row is missing.
    fn of(pictures: &Pictures) -> Option<FlowSums> {
        // Eight significant bits: the rest is below the noise of any taxel.
        let scale = (16 - pictures.peak.leading_zeros()).saturating_sub(8);
        let now = pictures.now.get(..pictures.rows)?;
        if now.iter().any(|row| row.len() != pictures.columns) || pictures.columns > SIDE {
            return None;
        }
        let (mut sums, mut line, mut terms) =
            (FlowSums::default(), SmoothRow::default(), SlopeTerms::default());
        let rows = pictures.before.array_windows().zip(now.array_windows()).zip(&pictures.inner[1..]);
        for ((before, now), marked) in rows.filter(|(_, marked)| **marked != 0) {
            smooth(before, now, &mut line);
            differentiate(&line, *marked, scale, &mut terms);
            sums.take(&terms, *marked);
        }
        Some(sums)
    }

    /// Adds the terms of the marked taxels of a row.
    fn take(&mut self, terms: &SlopeTerms, marked: u16) {
        self.count += marked.count_ones();
        let [x, xx, xy] = products::<0, 1>(terms);
        let [y, yy, yt] = products::<1, 2>(terms);
        let [t, tt, xt] = products::<2, 0>(terms);
        self.x += x;
        self.y += y;
        self.t += t;
        self.xx = self.xx.wrapping_add(xx);
        self.xy = self.xy.wrapping_add(xy);
        self.yy = self.yy.wrapping_add(yy);
        self.xt = self.xt.wrapping_add(xt);
        self.yt = self.yt.wrapping_add(yt);
        self.tt = self.tt.wrapping_add(tt);
    }

    /// Subtracts the means: a change that is the same everywhere is pressure, not motion.
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

    /// Solves `t = w (x, y)` for `w` by least squares; the displacement is `-4/3 w`.
    fn solve(mut self, expected: [i32; 2]) -> Flow {
        self.centre();
        let energy = (self.xx.max(0) as u32).saturating_add(self.yy.max(0) as u32);
        // The sums have wrapped: the pictures differ by more than the peak.
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
        // The standard deviation of w along a direction is that of the residual, divided by the root of the
        // slope's energy along it.
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
            // The expected displacement, corrected where there is a slope.
            let e = expected.map(|way| -((way.clamp(-2 << 16, 2 << 16) * 3) >> 6));
            let correct = |e, x, y, t: i32| e + per_energy.nearest(i64::from((t << 12) - x - y));
            [correct(e[0], xx * e[0], xy * e[1], xt), correct(e[1], xy * e[0], yy * e[1], yt)]
        });
        if w.iter().any(|w| w.abs() > LONGEST) || !clear(energy, w) {
            return Flow::Changed;
        }
        // The residual must be less than a displacement by half a taxel would leave.
        if left(w) > energy >> 3 {
            return Flow::Changed;
        }
        Flow::Moved(w.map(|w| -(w << 6) / 3))
    }
}

/// Longest accepted w: two taxels.
const LONGEST: i32 = 3 << 11;

/// Largest accepted standard deviation of w (0.101, which is 0.135 taxel), as 1/variance; for independent
/// taxels.
const CLEAR: i64 = 98;

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::f64::consts::TAU;

    type Pixels = [[u16; SIDE]; SIDE];

    /// All taxels except the border.
    const INNER: [u16; SIDE] = {
        let mut inner = [0x7fe; SIDE];
        (inner[0], inner[SIDE - 1]) = (0, 0);
        inner
    };

    fn picture(pressure: impl Fn(f64, f64) -> f64) -> Pixels {
        core::array::from_fn(|y| core::array::from_fn(|x| pressure(x as f64, y as f64).round() as u16))
    }

    fn pictures<'a>(before: &'a Pixels, now: &'a Pixels) -> Pictures<'a> {
        let peak = before.iter().chain(now).flatten().copied().max().unwrap();
        let now = now.each_ref().map(|row| &row[..]);
        Pictures { before, now, rows: SIDE, columns: SIDE, inner: &INNER, peak }
    }

    /// Waves of `length` along both axes, displaced by (dx, dy) taxels.
    fn waves(length: f64, [dx, dy]: [f64; 2], [unit, peak]: [f64; 2]) -> Pixels {
        let k = TAU / length;
        picture(|x, y| peak * (0.5 + unit * ((k * (x - dx)).cos() + (k * (y - dy) + 1.0).cos())))
    }

    #[test]
    fn a_wave_of_six_taxels_is_reported_within_a_hundredth() {
        for full in [255.0, 4095.0, 65535.0] {
            for way in [[0.05, 0.0], [0.0, -0.1], [0.1, 0.1], [-0.2, 0.05]] {
                let (before, now) = (waves(6.0, [0.0; 2], [0.2, full]), waves(6.0, way, [0.2, full]));
                let Flow::Moved(moved) = Flow::of(&pictures(&before, &now), [0; 2]) else {
                    panic!("{way:?}")
                };
                let moved = moved.map(|way| f64::from(way) / 65536.0);
                let error = (moved[0] - way[0]).hypot(moved[1] - way[1]);
                // Eight bits round to 1/255 of the peak.
                let rounding = if full < 256.0 { 0.01 } else { 0.0 };
                assert!(error < 0.015 * way[0].hypot(way[1]) + rounding, "{full} {way:?} {moved:?}");
            }
        }
        // Plain central differences find sin(k) / k of the slope, 17 % too little.
        let k = TAU / 6.0;
        assert!((1.0 - k.sin() / k - 0.17).abs() < 0.005);
        assert!((k.sin() / k / (2.0 / 3.0 + k.cos() / 3.0) - 1.0).abs() < 0.01);
    }

    #[test]
    fn more_pressure_everywhere_is_no_way() {
        let before = waves(7.0, [0.0; 2], [0.2, 4000.0]);
        let now = before.map(|row| row.map(|value| value + 60));
        let Flow::Moved(moved) = Flow::of(&pictures(&before, &now), [0; 2]) else { panic!() };
        assert!(moved.iter().all(|way| way.abs() < 65536 / 500), "{moved:?}");
    }

    #[test]
    fn what_is_no_motion_is_distinguished() {
        let flat = picture(|_, _| 2000.0);
        assert_eq!(Flow::of(&pictures(&flat, &flat), [0; 2]), Flow::Flat);
        let (one, other) = (waves(6.0, [0.0; 2], [0.2, 4000.0]), waves(4.0, [1.3, 0.7], [0.2, 4000.0]));
        assert_eq!(Flow::of(&pictures(&one, &other), [0; 2]), Flow::Changed);
        let missing = Pictures { rows: SIDE, now: [&[]; SIDE], ..pictures(&one, &one) };
        assert_eq!(Flow::of(&missing, [0; 2]), Flow::Changed);
    }

    #[test]
    fn along_a_ridge_the_way_is_the_expected_one() {
        let ridge = |dx: f64| picture(|x, _| 2000.0 + 1000.0 * (TAU / 7.0 * (x - dx)).cos());
        let (before, now) = (ridge(0.0), ridge(0.2));
        let Flow::Moved([x, y]) = Flow::of(&pictures(&before, &now), [0, 30_000]) else { panic!() };
        assert!((f64::from(x) / 65536.0 - 0.2).abs() < 0.005, "{x}");
        assert!((y - 30_000).abs() <= 64, "{y}: a step of w");
    }

    #[test]
    fn the_sums_of_any_picture_are_exact() {
        let mut state = 1u32;
        let mut next = || {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            state >> 8
        };
        for round in 0..2000u32 {
            // Only extremes, in stripes, columns and dots, so that slopes and changes are as large as
            // possible.
            let extreme = [255u16, 4095, u16::MAX][round as usize % 3];
            let [a, b, c] = [next(), next(), next()];
            let make = |shift: u32| -> Pixels {
                core::array::from_fn(|y| {
                    core::array::from_fn(|x| {
                        let (x, y) = (x as u32 + shift, y as u32);
                        let bit = (a >> ((x * (b % 3) / 2 + y * (c % 3) / 2) % 24)) & 1;
                        if bit == 1 { extreme } else { 0 }
                    })
                })
            };
            let (before, now) = (make(0), make(round % 5));
            let pictures = Pictures { peak: extreme, ..pictures(&before, &now) };
            let sums = FlowSums::of(&pictures).unwrap();
            let wide = wide(&before, &now, extreme);
            assert_eq!((sums.count, sums.all().map(i64::from)), (100, wide), "round {round}");
            // Nor does anything overflow in the solution.
            Flow::of(&pictures, [i32::MAX, i32::MIN]);
        }
    }

    impl FlowSums {
        fn all(&self) -> [i32; 9] {
            [self.x, self.y, self.t, self.xx, self.xy, self.yy, self.xt, self.yt, self.tt]
        }
    }

    /// The sums in 64 bits, from the definition.
    fn wide(before: &Pixels, now: &Pixels, peak: u16) -> [i64; 9] {
        let scale = (16 - peak.leading_zeros()).saturating_sub(8);
        let half = 1i64 << scale >> 1;
        let mut sums = [0; 9];
        for (row, column) in (1..SIDE - 1).flat_map(|row| (1..SIDE - 1).map(move |column| (row, column))) {
            let around = |weights: [[i64; 3]; 3], of: &dyn Fn(usize, usize) -> i64| -> i64 {
                let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
                places.map(|(i, j)| weights[i][j] * of(row + i - 1, column + j - 1)).sum()
            };
            let sum = |y: usize, x: usize| i64::from(before[y][x]) + i64::from(now[y][x]);
            let change = |y: usize, x: usize| i64::from(now[y][x]) - i64::from(before[y][x]);
            let x = (around([[-1, 0, 1], [-4, 0, 4], [-1, 0, 1]], &sum) + half) >> scale;
            let y = (around([[-1, -4, -1], [0, 0, 0], [1, 4, 1]], &sum) + half) >> scale;
            let t = (around([[1, 4, 1], [4, 16, 4], [1, 4, 1]], &change) + 2 * half) >> scale >> 1;
            for (sum, term) in sums.iter_mut().zip([x, y, t, x * x, x * y, y * y, x * t, y * t, t * t]) {
                *sum += term;
            }
        }
        sums
    }

    #[test]
    fn the_solution_is_that_of_wide_integers() {
        let mut rng = fastrand::Rng::with_seed(3);
        let mut ends = [0; 4];
        for round in 0..6000 {
            let full = [100.0, 255.0, 4000.0, 30000.0][rng.usize(..4)];
            let (across, deep) = ([1.0, 0.3, 0.05, 0.0][rng.usize(..4)], [0.25, 0.1, 0.02][rng.usize(..3)]);
            let waves = |way: [f64; 2], length: f64| {
                picture(|x, y| {
                    let [x, y] =
                        [(x - way[0]) / length, (y - way[1]) / length].map(|part| (TAU * part).cos());
                    full * (0.5 + deep * (x + across * y))
                })
            };
            let way = [0; 2].map(|_| rng.f64() * rng.f64() * 3.0 - 0.7);
            let length = 5.0 + 20.0 * rng.f64();
            let (before, mut now) = (waves([0.0; 2], length), waves(way, length));
            let noise = ([0.0, 1.0, 4.0, 16.0][rng.usize(..4)] * full / 256.0) as u16;
            now.iter_mut().flatten().for_each(|value| *value += rng.u16(..=noise));
            let expected = way.map(|way| (way * 65536.0) as i32 + rng.i32(-20_000..20_000));
            let flow = Flow::of(&pictures(&before, &now), expected);
            let peak = before.iter().chain(&now).flatten().copied().max().unwrap();
            let (plain, whole) = plain(wide(&before, &now, peak), 100, expected);
            assert_eq!(flow, plain, "round {round}: {way:?}");
            ends[match plain {
                Flow::Flat => 0,
                Flow::Changed => 1,
                Flow::Moved(_) => 2 + usize::from(whole),
            }] += 1;
        }
        assert!(ends.iter().all(|count| *count > 100), "{ends:?}");
    }

    /// The solution of the centred sums, with divisions in wide integers; and whether it needs no
    /// expectation.
    fn plain(sums: [i64; 9], count: i64, expected: [i32; 2]) -> (Flow, bool) {
        let nearest = |value: i64, divisor: i64| (value + divisor / 2).div_euclid(divisor);
        let [sx, sy, st, xx, xy, yy, xt, yt, tt] = sums;
        let [x, y, t] = [sx, sy, st].map(|sum| nearest(sum, count));
        let centred = [xx - x * sx, xy - x * sy, yy - y * sy, xt - x * st, yt - y * st, tt - t * st];
        let energy = centred[0] + centred[2];
        if energy < 64 * count {
            return (Flow::Flat, false);
        }
        let down = (64 - energy.leading_zeros()).saturating_sub(14);
        let [xx, xy, yy, xt, yt, tt] = centred.map(|sum| sum >> down);
        let energy = xx + yy;
        if xt.abs().max(yt.abs()) > 2 * energy {
            return (Flow::Changed, false);
        }
        let left = |w: [i64; 2]| (tt - ((w[0] * xt + w[1] * yt) >> 12)).max(0);
        let clear = |energy: i64, w: [i64; 2]| energy * count >= left(w) * 98;
        let determinant = xx * yy - xy * xy;
        let mut whole = None;
        if determinant >= energy * energy / 64 {
            let w = [yy * xt - xy * yt, xx * yt - xy * xt].map(|n| nearest(n * 4096, determinant));
            let is_near = w.iter().all(|w| w.abs() <= 6144);
            whole = (is_near && clear(nearest(determinant, energy), w)).then_some(w);
        }
        let w = whole.unwrap_or_else(|| {
            let e = expected.map(|way| -((i64::from(way).clamp(-131_072, 131_072) * 3) >> 6));
            let rest = [xt * 4096 - xx * e[0] - xy * e[1], yt * 4096 - xy * e[0] - yy * e[1]];
            [0, 1].map(|axis| e[axis] + nearest(rest[axis], energy))
        });
        let fits = w.iter().all(|w| w.abs() <= 6144) && clear(energy, w) && left(w) <= energy / 8;
        let way = w.map(|w| (-w * 64 / 3) as i32);
        (if fits { Flow::Moved(way) } else { Flow::Changed }, whole.is_some())
    }
}
