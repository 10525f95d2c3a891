//! Pressure as colour: viridis, which is perceptually uniform and safe for colour-blind readers. Without
//! colour: characters of growing weight.

use ratatui::style::Color;

/// Ten samples of viridis.
const VIRIDIS: [[u8; 3]; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x49, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6e, 0xce, 0x58],
    [0xb5, 0xde, 0x2b],
    [0xfd, 0xe7, 0x25],
];

/// Characters of growing weight; the first is a taxel without pressure.
pub const GLYPHS: [char; 10] = ['.', ':', '-', '=', '+', 'o', '*', '#', '%', '@'];

/// How pressure is drawn.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Paint {
    /// Two coloured pixels in a character.
    #[default]
    Colours,
    /// One of [`GLYPHS`] for two pixels, by the greater of the two pressures.
    Glyphs,
}

impl Paint {
    /// The user's choice: a non-empty `NO_COLOR` selects characters (<https://no-color.org>).
    pub fn wanted() -> Paint {
        match std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty()) {
            true => Paint::Glyphs,
            false => Paint::Colours,
        }
    }
}

/// Red, green, blue.
pub type Rgb = [u8; 3];

/// Colour of a pressure on a scale that ends at `top` counts.
pub fn pressure(value: u16, top: u16) -> Rgb {
    ramp(part(value, top))
}

/// Character of a pressure on this scale; any pressure is heavier than none.
pub fn glyph(value: u16, top: u16) -> char {
    let steps = GLYPHS.len() - 1;
    GLYPHS[((part(value, top) * steps as f32).ceil() as usize).min(steps)]
}

/// Position on the scale, 0 ..= 1. It is a square root, so that light touches stay visible beside hard ones.
fn part(value: u16, top: u16) -> f32 {
    (f32::from(value) / f32::from(top.max(1))).min(1.0).sqrt()
}

/// Colour at a position, 0 ..= 1, of the ramp.
pub fn ramp(part: f32) -> Rgb {
    let place = part.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f32;
    let index = (place as usize).min(VIRIDIS.len() - 2);
    mix(VIRIDIS[index], VIRIDIS[index + 1], place - index as f32)
}

/// Interpolates from `a` (0) to `b` (1).
pub fn mix(a: Rgb, b: Rgb, part: f32) -> Rgb {
    let between = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * part).round() as u8;
    [between(a[0], b[0]), between(a[1], b[1]), between(a[2], b[2])]
}

/// Converts a colour to the terminal's.
pub fn color([r, g, b]: Rgb) -> Color {
    Color::Rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_rises_in_lightness() {
        let light = |[r, g, b]: Rgb| 2126 * u32::from(r) + 7152 * u32::from(g) + 722 * u32::from(b);
        let all: Vec<_> = (0..=400).map(|v| light(pressure(v, 400))).collect();
        // Except for rounding to 8 bits.
        assert!(all.windows(2).all(|pair| pair[0] <= pair[1] + 10_000));
        assert_eq!(pressure(0, 400), VIRIDIS[0]);
        assert_eq!(pressure(4095, 400), VIRIDIS[9]);
        assert_eq!(pressure(1, 0), VIRIDIS[9]);
    }

    #[test]
    fn glyphs_grow_with_pressure() {
        let all: Vec<char> = (0..=400).map(|value| glyph(value, 400)).collect();
        let mut steps = all.clone();
        steps.dedup();
        assert_eq!(steps, GLYPHS);
        assert_eq!((all[0], all[1], glyph(4095, 400), glyph(1, 0)), ('.', ':', '@', '@'));
    }
}
