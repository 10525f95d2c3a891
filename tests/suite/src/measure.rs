//! Centroid, NMI and azimuth of a window in several number formats.

use crate::windows::SIDE;
use micromath::F32Ext;
use taxel_core::contact::{Moments, axis};
use taxel_core::format::{Code, Fixed16, Fixed24, Inverse, Scaled, Turn};

/// Number format of the computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Exact integer sums, one rounding at the end, like the core.
    Exact,
    /// Weights of 15 bits, all arithmetic in 32 bits.
    Q15,
    /// Exact integer sums, then f32 with micromath's root and arctangent.
    SumsMicromath,
    /// Exact integer sums, then f32 with libm.
    SumsLibm,
    /// All in f32, with micromath.
    Micromath,
    /// All in f32, with libm.
    Libm,
}

/// Results in their format: column and row of the centroid, NMI (eq. 4 of the source), azimuth.
pub type RawMoments = [u32; 4];

impl Measure {
    /// All of them.
    pub const ALL: [Measure; 6] = [
        Measure::Exact,
        Measure::Q15,
        Measure::SumsMicromath,
        Measure::SumsLibm,
        Measure::Micromath,
        Measure::Libm,
    ];

    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Measure::Exact => "exact integers",
            Measure::Q15 => "Q15",
            Measure::SumsMicromath => "integer sums, f32 micromath",
            Measure::SumsLibm => "integer sums, f32 libm",
            Measure::Micromath => "f32 micromath",
            Measure::Libm => "f32 libm",
        }
    }

    /// Measures a window of 16 x 16 taxels that are not all 0.
    #[inline(never)]
    pub fn of(self, window: &[Code]) -> RawMoments {
        match self {
            Measure::Exact => exact(window),
            Measure::Q15 => q15(window),
            Measure::SumsMicromath => finish(&MomentSums::exact(window), F32Ext::sqrt, F32Ext::atan2),
            Measure::SumsLibm => finish(&MomentSums::exact(window), libm::sqrtf, libm::atan2f),
            Measure::Micromath => finish(&MomentSums::of(window), F32Ext::sqrt, F32Ext::atan2),
            Measure::Libm => finish(&MomentSums::of(window), libm::sqrtf, libm::atan2f),
        }
    }

    /// Values of the results: taxels, NMI, radians.
    pub fn values(self, raw: RawMoments) -> [f64; 4] {
        let [x, y, nmi, azimuth] = raw;
        match self {
            Measure::Exact => [
                Fixed16(x as i32).to_f64(),
                Fixed16(y as i32).to_f64(),
                Fixed24(nmi).to_f64(),
                Turn(azimuth as i32).to_radians(),
            ],
            Measure::Q15 => {
                let [x, y] = [x, y].map(|centre| f64::from(centre) / 32768.0);
                [x, y, f64::from(nmi) / f64::from(1 << NMI_BITS), Turn(azimuth as i32).to_radians()]
            }
            _ => raw.map(|bits| f64::from(f32::from_bits(bits))),
        }
    }
}

/// Moments of the window, row by row.
fn moments(window: &[Code]) -> Moments {
    let mut sum = Moments::default();
    for (y, row) in window.chunks(SIDE).enumerate() {
        let mut values = [0; SIDE];
        for (value, code) in values.iter_mut().zip(row) {
            *value = code.0;
        }
        sum.add(&Moments::of_run(0, y as u32, &values));
    }
    sum
}

fn exact(window: &[Code]) -> RawMoments {
    let sums = moments(window);
    let mass = Inverse::of(sums.m as u32);
    let [x, y] = [sums.sx, sums.sy].map(|sum| mass.nearest(sum << 16) as u32);
    let inverse = Scaled::from_u64(1).over(Scaled::from_u64(sums.m));
    let nmi = Scaled::from_u64(sums.jm()).times(inverse).sqrt().times(inverse).to_fixed24().0;
    let area = window.iter().filter(|code| code.0 > 0).count() as u32;
    let azimuth = axis(&sums.central(), area).azimuth.unwrap_or_default().0 as u32;
    [x, y, nmi, azimuth]
}

/// Fraction bits of the NMI in 32 bits.
const NMI_BITS: u32 = 21;

/// Uses weights `f / m` of 15 bits: the window may have at most 16 x 16 taxels of 12 bits.
fn q15(window: &[Code]) -> RawMoments {
    let mass: u32 = window.iter().map(|code| u32::from(code.0)).sum();
    let inverse = (1u32 << 31).checked_div(mass).unwrap_or(0);
    let weight = |code: &Code| (u32::from(code.0) * inverse + (1 << 15)) >> 16;
    let (mut x, mut y) = (0u32, 0u32);
    for (row, codes) in window.chunks(SIDE).enumerate() {
        for (column, code) in codes.iter().enumerate() {
            let weight = weight(code);
            x += weight * column as u32;
            y += weight * row as u32;
        }
    }
    // About the centroid; distances and squares have 8 fraction bits.
    let [mut a, mut b, mut c] = [0i32; 3];
    for (row, codes) in window.chunks(SIDE).enumerate() {
        let dy = ((row as i32) << 15).wrapping_sub(y as i32) >> 7;
        for (column, code) in codes.iter().enumerate() {
            let dx = ((column as i32) << 15).wrapping_sub(x as i32) >> 7;
            let weight = weight(code) as i32;
            a = a.wrapping_add(weight * ((dx * dx) >> 8));
            b = b.wrapping_add(weight * ((dy * dy) >> 8));
            c = c.wrapping_add(weight * ((dx * dy) >> 8));
        }
    }
    let spread = (a.wrapping_add(b) as u32) << 1;
    let (spread, mass) = (spread.isqrt(), (mass << 10).isqrt());
    // 12 fraction bits of the spread, 5 of the mass.
    let nmi = (spread << (NMI_BITS - 12 + 5)).checked_div(mass).unwrap_or(0);
    let azimuth = idsp::atan2(c.wrapping_mul(2), a.wrapping_sub(b)) >> 1;
    [x, y, nmi, azimuth as u32]
}

/// Sums in f32, for the rest of the computation.
struct MomentSums {
    m: f32,
    sx: f32,
    sy: f32,
    /// `m sxx - sx^2`; `b` and `c` likewise.
    a: f32,
    b: f32,
    c: f32,
}

impl MomentSums {
    fn exact(window: &[Code]) -> MomentSums {
        let sums = moments(window);
        let central = sums.central();
        MomentSums {
            m: sums.m as f32,
            sx: sums.sx as f32,
            sy: sums.sy as f32,
            a: central.a as f32,
            b: central.b as f32,
            c: central.c as f32,
        }
    }

    fn of(window: &[Code]) -> MomentSums {
        let [mut m, mut sx, mut sy, mut sxx, mut syy, mut sxy] = [0f32; 6];
        for (row, codes) in window.chunks(SIDE).enumerate() {
            let y = row as f32;
            for (column, code) in codes.iter().enumerate() {
                let (x, f) = (column as f32, f32::from(code.0));
                m += f;
                sx += x * f;
                sy += y * f;
                sxx += x * x * f;
                syy += y * y * f;
                sxy += x * y * f;
            }
        }
        MomentSums { m, sx, sy, a: m * sxx - sx * sx, b: m * syy - sy * sy, c: m * sxy - sx * sy }
    }
}

fn finish(sums: &MomentSums, root: fn(f32) -> f32, arctangent: fn(f32, f32) -> f32) -> RawMoments {
    let MomentSums { m, sx, sy, a, b, c } = *sums;
    [sx / m, sy / m, root((a + b) / m) / m, 0.5 * arctangent(2.0 * c, a - b)].map(f32::to_bits)
}
