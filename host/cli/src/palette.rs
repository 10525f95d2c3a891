//! Colours and scale of pressure, and colours of the intentions: the same in the terminal, on the page and in a
//! report. The page gets them from the program, see `view/message.rs`.

use serde::Serialize;
use serde_json::{Map, Value};
use taxel_core::intent::Leading;

/// Colours and scale of pressure, and colours of the intentions.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PagePalette {
    /// Red, green and blue of each step.
    pub ramp: Vec<Rgb>,
    /// Number of equal parts of the scale.
    pub bands: u16,
    /// End of the scale at the beginning, counts.
    pub start: u16,
    /// Least and greatest end of the scale, counts.
    pub ends: [u16; 2],
    /// Colour of each intention, `#rrggbb`.
    #[cfg_attr(feature = "schema", schemars(with = "std::collections::BTreeMap<String, String>"))]
    pub intentions: Map<String, Value>,
    /// Colour of feelings, `#rrggbb`.
    pub feeling: String,
}

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// Ten samples of cividis (Nunez, Anderton, Renslow 2018), which is readable with any colour vision and grows
/// evenly in lightness.
const CIVIDIS: [Rgb; 10] = [
    [0, 34, 78],
    [18, 53, 112],
    [59, 73, 108],
    [87, 93, 109],
    [112, 113, 115],
    [138, 134, 120],
    [165, 156, 116],
    [195, 179, 105],
    [225, 204, 85],
    [254, 232, 56],
];

/// Colours of the ramp.
pub const STEPS: usize = 256;
/// Equal parts of the scale: contours separate them, and taxels are counted in each.
pub const BANDS: u16 = 5;
/// End of the scale at the beginning, counts.
pub const START: u16 = 200;
/// Least and greatest end of the scale, counts; each of the ends between is twice the one before.
pub const ENDS: [u16; 2] = [25, 51_200];

/// Colour of a step of the ramp.
pub fn ramp(step: usize) -> Rgb {
    let place = step.min(STEPS - 1) as f64 / (STEPS - 1) as f64 * (CIVIDIS.len() - 1) as f64;
    let index = (place as usize).min(CIVIDIS.len() - 2);
    mix(CIVIDIS[index], CIVIDIS[index + 1], place - index as f64)
}

/// Step of a pressure on a scale that ends at `top` counts: the scale is even.
pub fn step(value: u16, top: u16) -> usize {
    let part = (f64::from(value) / f64::from(top.max(1))).min(1.0);
    (part * (STEPS - 1) as f64).round() as usize
}

/// Colour of a pressure on a scale that ends at `top` counts.
pub fn pressure(value: u16, top: u16) -> Rgb {
    ramp(step(value, top))
}

/// The smallest end of the scale at or above a pressure, counts.
pub fn end_for(greatest: u16) -> u16 {
    ends(ENDS[0]).find(|end| *end >= greatest).unwrap_or(ENDS[1])
}

/// End of the scale of a still picture, counts: that at the beginning, so that a touch has the same colour as
/// elsewhere, unless more than half of the pressed taxels lie beyond it.
pub fn end_of(image: &[u16]) -> u16 {
    let above = |end: u16| image.iter().filter(|value| **value > end).count();
    let fits = |end: &u16| 2 * above(*end) <= above(0);
    ends(START).find(fits).unwrap_or(ENDS[1])
}

/// Ends of the scale from this one on.
fn ends(from: u16) -> impl Iterator<Item = u16> {
    std::iter::successors(Some(from), |end| end.checked_mul(2).filter(|end| *end <= ENDS[1]))
}

/// Interpolates from `a` (0) to `b` (1).
pub fn mix(a: Rgb, b: Rgb, part: f64) -> Rgb {
    let between = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * part).round() as u8;
    [between(a[0], b[0]), between(a[1], b[1]), between(a[2], b[2])]
}

/// Colour of an intention: of Okabe and Ito, which the colour-blind can distinguish.
pub fn intention(leading: Leading) -> Rgb {
    match leading {
        Leading::None => [128, 128, 128],
        Leading::Kindness => [0, 158, 115],
        Leading::Threat => [230, 159, 0],
        Leading::Attack => [213, 94, 0],
    }
}

/// Colour of feelings: no other colour means them.
pub const FEELING: Rgb = [214, 86, 143];

/// `#rrggbb`
pub fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// All of it, as the page gets it.
pub fn for_page() -> PagePalette {
    let intentions = Leading::INTENTIONS.into_iter();
    let colour = |leading: Leading| (leading.as_str().to_string(), hex(intention(leading)).into());
    PagePalette {
        ramp: (0..STEPS).map(ramp).collect(),
        bands: BANDS,
        start: START,
        ends: ENDS,
        intentions: intentions.map(colour).collect(),
        feeling: hex(FEELING),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_rises_in_lightness_from_end_to_end() {
        let light = |[r, g, b]: Rgb| 2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b);
        let all: Vec<_> = (0..=400).map(|v| light(pressure(v, 400))).collect();
        // Except for rounding to 8 bits.
        assert!(all.windows(2).all(|pair| pair[0] <= pair[1] + 10_000));
        assert_eq!(
            [pressure(0, 400), pressure(4095, 400), pressure(1, 0)],
            [CIVIDIS[0], CIVIDIS[9], CIVIDIS[9]]
        );
        assert_eq!(step(100, 200), 128);
    }

    #[test]
    fn a_still_picture_begins_like_a_live_one() {
        assert_eq!([end_of(&[]), end_of(&[0, 0, 7]), end_of(&[0, 100, 4000])], [START; 3]);
        assert_eq!([end_of(&[500, 900, 100]), end_of(&[u16::MAX])], [800, ENDS[1]]);
        assert_eq!([0, 25, 26, 250, u16::MAX].map(end_for), [25, 25, 50, 400, ENDS[1]]);
    }
}
