//! Pressure in a terminal: as colour, or as characters of growing weight.

use crate::palette::{Rgb, STEPS, step};
use ratatui::style::Color;

/// Characters of growing weight; the first is a taxel without pressure.
pub const GLYPHS: [char; 10] = ['.', ':', '-', '=', '+', 'o', '*', '#', '%', '@'];

/// Way in which pressure is drawn.
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

/// Character of a pressure on a scale that ends at `top` counts; any pressure is heavier than none.
pub fn glyph(value: u16, top: u16) -> char {
    let last = GLYPHS.len() - 1;
    let weight = (step(value, top) * last).div_ceil(STEPS - 1);
    GLYPHS[weight.max(usize::from(value > 0)).min(last)]
}

/// Converts a colour to the terminal's.
pub fn color([r, g, b]: Rgb) -> Color {
    Color::Rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glyphs_grow_with_pressure() {
        let all: Vec<char> = (0..=400).map(|value| glyph(value, 400)).collect();
        let mut steps = all.clone();
        steps.dedup();
        assert_eq!(steps, GLYPHS);
        assert_eq!((all[0], all[1], glyph(4095, 400), glyph(1, 0)), ('.', ':', '@', '@'));
    }
}
