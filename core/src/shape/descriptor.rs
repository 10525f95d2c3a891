//! The descriptor: measures of a touch for a [`Gallery`](super::Gallery).

use super::nmi::sheppard;
use super::outline::Outline;
use super::patch::Patch;
use super::spread::{Spread, length};
use crate::contact::{Moments, axis};
use crate::format::{Q15, Scaled};

/// Number of measures of a descriptor.
pub const MEASURES: usize = 24;

/// Names of the measures, in their order.
pub const MEASURE_NAMES: [&str; MEASURES] = [
    "nmi_s2",
    "nmi_s2_sheppard",
    "nmi_peak_sheppard",
    "nmi_area",
    "anisotropy",
    "anisotropy_area",
    "kurtosis",
    "lean",
    "three",
    "four",
    "offset",
    "evenness",
    "fullness",
    "total",
    "area",
    "half_area",
    "top_area",
    "sides",
    "half_sides",
    "slope",
    "rim",
    "variation",
    "summits",
    "euler",
];

/// Measures of a touch, in the order of [`MEASURE_NAMES`]; see [`descriptor`].
pub type Descriptor = [i16; MEASURES];

/// Computes the descriptor of a touch. Logarithms are to base 2 in 1/1024, ratios in 1/4096; J is the moment
/// of inertia about the centroid, and "area" counts taxels.
///
/// | | | |
/// |---|---|---|
/// | nmi_s2 | log NMI sqrt(sum f^2 / sum f) | even disc: log 0.399 |
/// | nmi_s2_sheppard, nmi_peak_sheppard | log of the forms with Sheppard's correction | |
/// | nmi_area | log of the NMI of the area, corrected | outline alone |
/// | anisotropy, anisotropy_area | of pressure, of the area | 0: disc, 1: line |
/// | kurtosis | log m sum r^4 f / J^2 | disc: log 4/3, ring: 0 |
/// | lean | abs sum z r^2 f / (m (J / m)^(3/2)); z = x + iy from the centroid | to one side |
/// | three | abs sum z^3 f / (m (sum r^4 f)^3)^(1/4) | 0 .. 1: three corners |
/// | four | abs sum z^4 f / sum r^4 f | 0 .. 1: four corners |
/// | offset | from the centroid of the pressure to that of the area, by sqrt(J / m) | |
/// | evenness | log of mean / peak | |
/// | fullness | log of (sum f^2 / sum f) / peak | |
/// | total, area | log | follow size (and pressure) |
/// | half_area, top_area | log of the share from 1/2 and 3/4 of the peak on | |
/// | sides, half_sides | log of the outline by sqrt(area), at the threshold and half the peak | square: log 4 |
/// | slope | log of 1/64 + mean Sobel / 8 on the rim, by the peak | |
/// | rim | log of the share of the area on the rim | |
/// | variation | log of the sum of all differences between neighbours, by m | |
/// | summits | log of 1 + taxels not below any neighbour | |
/// | euler | log of 1 + the Euler number, with its sign: parts less holes | |
///
/// Never panics; all measures are 0 without pressure. The moments are exact, and values derived from them are
/// rounded to the nearest step. Sums of higher order use coordinates rounded as in [`Spread`]. The resulting
/// errors are tested against floats.
pub fn descriptor(patch: &Patch) -> Descriptor {
    let moments = Moments::of_image(patch.values(), patch.columns());
    let peak = patch.values().iter().copied().max().unwrap_or(0);
    if moments.m == 0 {
        return [0; MEASURES];
    }
    let (outline, spread, cover) =
        (Outline::of(patch, peak), Spread::of(patch, &moments, peak), patch.cover());
    let log = |value: u64| Scaled::from_u64(value).log2();
    let (m, s2, area, top) = (log(moments.m), log(moments.s2), log(cover.m), log(peak.into()));
    let [narrow, wide] = inertia(&moments);
    let [outer, _] = inertia(&cover);
    let anisotropy = |moments: &Moments| ratio(axis(&moments.central(), 0).anisotropy);
    let [lean, three, four, offset] = directions(&moments, &cover, &spread);
    let share = |part: u32| log(part.into()) - area;
    let euler = log(u64::from(outline.euler12.unsigned_abs() / 12) + 1) * outline.euler12.signum();
    [
        saturated((wide + s2 - 4 * m) / 2),
        saturated((narrow + s2 - 4 * m) / 2),
        saturated((narrow + top - 3 * m) / 2),
        saturated((outer - 3 * area) / 2),
        anisotropy(&moments),
        anisotropy(&cover),
        saturated(kurtosis(&spread)),
        lean,
        three,
        four,
        offset,
        saturated(m - area - top),
        saturated(s2 - m - top),
        saturated(m),
        saturated(area),
        saturated(share(outline.half_area)),
        saturated(share(outline.top_area)),
        saturated(log(outline.sides.into()) - area / 2),
        saturated(log(outline.half_sides.into()) - log(outline.half_area.into()) / 2),
        slope(&outline, peak),
        saturated(share(outline.rim)),
        saturated(log(outline.variation) - m),
        saturated(log(u64::from(outline.summits) + 1)),
        saturated(euler),
    ]
}

fn saturated(value: i32) -> i16 {
    value.clamp(i16::MIN.into(), i16::MAX.into()) as i16
}

/// Converts to 1/4096, at most just below 8.
fn ratio(value: Q15) -> i16 {
    saturated((value.0 + 4) >> 3)
}

/// Logarithms of `J m` with Sheppard's correction and without; at least that of a single taxel, whose square
/// has `m^2 / 12` after correction.
fn inertia(moments: &Moments) -> [i32; 2] {
    let (m, jm) = (Scaled::from_u64(moments.m), moments.jm());
    let pixel = m.times(m).times(TWELFTH).log2();
    [sheppard(jm, moments.m), Scaled::from_u64(jm)].map(|inertia| inertia.log2().max(pixel))
}

const TWELFTH: Scaled = Scaled::from_u64(1).over(Scaled::from_u64(12));

/// Logarithm of `m sum r^4 f / J^2`; 0 for a single taxel.
fn kurtosis(spread: &Spread) -> i32 {
    if spread.r2 == 0 {
        return 0;
    }
    let log = |value: u64| Scaled::from_u64(value).log2();
    log(spread.m) + log(spread.r4) + (8 << 10) - 2 * log(spread.r2)
}

/// Returns lean, three, four and offset.
fn directions(moments: &Moments, cover: &Moments, spread: &Spread) -> [i16; 4] {
    let (m, r2, r4) = (Scaled::from_u64(spread.m), Scaled::from_u64(spread.r2), Scaled::from_u64(spread.r4));
    if spread.r2 == 0 {
        return [0; 4];
    }
    // By Hoelder's inequality, not below sum r^3 f.
    let third = m.times(r4.times(r4).times(r4)).shifted(24).sqrt().sqrt();
    let own = r2.times(r2.over(m).sqrt());
    let by = |vector: [i64; 2], size: Scaled| ratio(length(vector).over(size).to_q15());
    // The difference of the centroids times both masses is exact; J / m = J m / m^2.
    let between = [(moments.sx, cover.sx), (moments.sy, cover.sy)].map(|(sum, covered)| {
        let (there, here) = (sum.wrapping_mul(cover.m as i64), covered.wrapping_mul(moments.m as i64));
        there.wrapping_sub(here)
    });
    let radius = Scaled::from_u64(moments.jm()).sqrt().times(Scaled::from_u64(cover.m));
    [by(spread.lean, own), by(spread.three, third), by(spread.four, r4), by(between, radius)]
}

/// Logarithm of 1/64 + the mean slope of the rim divided by the peak.
fn slope(outline: &Outline, peak: u16) -> i16 {
    let steepness = Scaled::from_u64(outline.rim.into()).times(Scaled::from_u64(peak.into()));
    let mean = Scaled::from_u64(outline.slope).over(steepness).to_fixed(16);
    saturated(Scaled::from_u64(u64::from(mean) + 1024).shifted(-16).log2())
}
