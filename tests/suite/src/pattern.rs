//! Scenes of touches on the reference garment: pressure and codes of every taxel in every frame, computed in
//! integers.

use crate::chain::{FULL_SCALE, TAXELS};
use taxel_core::format::Code;

/// Number of columns of a panel of the reference garment.
pub const COLUMNS: usize = 16;
/// Number of rows of a panel.
pub const ROWS: usize = 32;

/// Units of a [`Disc`]'s place and radius per taxel.
pub const UNITS: i32 = 20;

/// A scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TouchPattern {
    /// Noise alone.
    Empty,
    /// One disc.
    One,
    /// Five discs on all panels, one across the seam of chest and back; each moves 0.1 taxel a frame.
    Five,
    /// Sixteen discs, four on each panel, that move as those five: some 500 taxels, never more than 512.
    Sixteen,
    /// Forty contacts of 2 x 2 to 3 x 3 taxels: more than can be tracked.
    Forty,
    /// Every taxel pressed, with 11 random bits on top of it.
    Texture,
    /// The greatest code everywhere.
    Flat,
    /// Every second taxel of every second row: 512 labels.
    Grid,
    /// Every second taxel, like the fields of one colour on a chessboard.
    Checkerboard,
}

/// A dome of pressure, `PEAK sqrt(1 - (r / radius)^2)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Disc {
    /// The panel whose coordinates it is given in.
    pub panel: usize,
    /// Column of its centre, in 1/20 taxel.
    pub x: i32,
    /// Row of its centre, in 1/20 taxel.
    pub y: i32,
    /// Its radius, in 1/20 taxel.
    pub radius: i32,
}

/// Radius of a disc: 3 taxels, about 29 of them; and of one of sixteen, about 32.
const RADIUS: i32 = 3 * UNITS;
const WIDER: i32 = RADIUS + 3;
/// Pressure at its centre, counts.
const PEAK: u32 = 1500;

impl Disc {
    /// Pressure at a taxel of the disc's panel, or beyond its border, counts.
    pub fn pressure(&self, column: i32, row: i32) -> u16 {
        let (dx, dy) = (column * UNITS - self.x, row * UNITS - self.y);
        let left = (self.radius * self.radius - dx * dx - dy * dy).max(0) as u32;
        // Square root with five extra bits.
        (PEAK * (left << 10).isqrt() / (self.radius.unsigned_abs() << 5)) as u16
    }

    /// Adds its pressure to the image of the garment; the part beyond the right flank of the chest lies on
    /// the back.
    fn press(&self, image: &mut [u16; TAXELS]) {
        for (row, column) in (0..ROWS as i32).flat_map(|row| (0..2 * COLUMNS as i32).map(move |c| (row, c))) {
            let (panel, inside) = match column.checked_sub(COLUMNS as i32) {
                Some(beyond @ 0..) if self.panel == 0 => (1, beyond),
                Some(0..) => continue,
                _ => (self.panel, column),
            };
            let taxel = panel * ROWS * COLUMNS + row as usize * COLUMNS + inside as usize;
            if let Some(value) = image.get_mut(taxel) {
                *value += self.pressure(column, row);
            }
        }
    }
}

impl TouchPattern {
    /// All patterns.
    pub const ALL: [TouchPattern; 9] = [
        TouchPattern::Empty,
        TouchPattern::One,
        TouchPattern::Five,
        TouchPattern::Sixteen,
        TouchPattern::Forty,
        TouchPattern::Texture,
        TouchPattern::Flat,
        TouchPattern::Grid,
        TouchPattern::Checkerboard,
    ];

    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            TouchPattern::Empty => "empty",
            TouchPattern::One => "1 contact",
            TouchPattern::Five => "5 contacts",
            TouchPattern::Sixteen => "16 contacts",
            TouchPattern::Forty => "40 contacts",
            TouchPattern::Texture => "saturated",
            TouchPattern::Flat => "flat 4095",
            TouchPattern::Grid => "512 labels",
            TouchPattern::Checkerboard => "checkerboard",
        }
    }

    /// The discs of a frame.
    pub fn discs(self, frame: u32) -> impl Iterator<Item = Disc> {
        // Back and forth over 8 taxels, 0.1 taxel a frame.
        let step = 2 * frame as i32 % 320;
        let along = if step < 160 { step } else { 320 - step };
        let disc = |panel, x, y| Disc { panel, x, y, radius: RADIUS };
        let discs = [
            disc(0, 80 + along / 2, 200),
            // Mostly on the chest, the rest on the back.
            disc(0, 293, 400 + along),
            disc(1, 113, 331 - along),
            disc(2, 207 - along / 2, 100 + along),
            disc(3, 150, 311 + along),
        ];
        let (five, sixteen) = match self {
            TouchPattern::One => (1, 0),
            TouchPattern::Five => (5, 0),
            TouchPattern::Sixteen => (0, 16),
            _ => (0, 0),
        };
        // Each lies otherwise between the taxels, so that together they press as many in each frame.
        let apart = move |number: i32| Disc {
            panel: number as usize / 4,
            x: 80 + along + number % 14,
            y: 80 + 160 * (number % 4) + 7 * number % 10,
            radius: WIDER,
        };
        discs.into_iter().take(five).chain((0..sixteen).map(apart))
    }

    /// Pressure of every taxel in a frame, counts, without noise.
    pub fn pressure(self, frame: u32, image: &mut [u16; TAXELS]) {
        for (taxel, value) in image.iter_mut().enumerate() {
            let (row, column) = (taxel / COLUMNS, taxel % COLUMNS);
            *value = match self {
                TouchPattern::Empty | TouchPattern::One | TouchPattern::Five | TouchPattern::Sixteen => 0,
                TouchPattern::Forty => small(row, column),
                TouchPattern::Texture => 64 + (hash(taxel as u32, 1) & 0x7ff) as u16,
                TouchPattern::Flat => FULL_SCALE,
                TouchPattern::Grid => 1000 * u16::from(row % 2 == 0 && column % 2 == 0),
                TouchPattern::Checkerboard => 1000 * u16::from((row + column) % 2 == 0),
            };
        }
        self.discs(frame).for_each(|disc| disc.press(image));
    }

    /// Codes of a frame: offset of the taxel, plus noise, plus pressure.
    pub fn codes(self, frame: u32, codes: &mut [Code; TAXELS]) {
        let mut image = [0; TAXELS];
        self.pressure(frame, &mut image);
        for (taxel, (code, pressure)) in codes.iter_mut().zip(image).enumerate() {
            let offset = 80 + hash(taxel as u32, 2) % 41;
            let noise = hash(taxel as u32, 3 + frame) % 5;
            *code =
                Code((u32::from(pressure) + offset + noise).saturating_sub(2).min(FULL_SCALE.into()) as u16);
        }
    }
}

/// A contact on every third field of 4 x 4 taxels, forty in all, two or three taxels wide and high.
fn small(row: usize, column: usize) -> u16 {
    let field = row / 4 * 4 + column / 4;
    let (wide, high) = (2 + field % 2, 2 + field / 3 % 2);
    let inside = field.is_multiple_of(3) && field < 120 && row % 4 < high && column % 4 < wide;
    if inside { 300 + field as u16 * 8 } else { 0 }
}

/// Returns pseudo-random bits for a taxel; `salt` separates purposes.
pub(crate) const fn hash(taxel: u32, salt: u32) -> u32 {
    let mut bits = taxel.wrapping_mul(0x9e37_79b1) ^ salt.wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ bits >> 15).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ bits >> 12).wrapping_mul(0x297a_2d39);
    bits ^ bits >> 15
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pressed(pattern: TouchPattern, frame: u32) -> usize {
        let mut image = [0; TAXELS];
        pattern.pressure(frame, &mut image);
        image.iter().filter(|value| **value > 0).count()
    }

    #[test]
    fn scenes_press_as_many_taxels_as_they_say() {
        assert_eq!(
            [TouchPattern::Empty, TouchPattern::Texture, TouchPattern::Flat].map(|p| pressed(p, 0)),
            [0, 2048, 2048]
        );
        assert_eq!([TouchPattern::Grid, TouchPattern::Checkerboard].map(|p| pressed(p, 0)), [512, 1024]);
        for frame in 0..400 {
            assert!((5 * 24..=5 * 32).contains(&pressed(TouchPattern::Five, frame)), "frame {frame}");
            let discs = TouchPattern::Five.discs(frame).zip(TouchPattern::Five.discs(frame + 1));
            for (disc, next) in discs {
                let moved = (next.x - disc.x).abs().max((next.y - disc.y).abs());
                assert!(moved <= UNITS / 10);
            }
            assert!((490..=512).contains(&pressed(TouchPattern::Sixteen, frame)), "frame {frame}");
        }
        assert!((40 * 4..=40 * 9).contains(&pressed(TouchPattern::Forty, 0)));
    }

    #[test]
    fn noise_stays_within_two_counts_of_an_offset_of_100_within_20() {
        for frame in 0..50 {
            let mut codes = [Code(0); TAXELS];
            TouchPattern::Empty.codes(frame, &mut codes);
            assert!(codes.iter().all(|code| (78..=122).contains(&code.0)));
        }
    }
}
