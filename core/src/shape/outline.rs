//! Measures of neighbouring taxels of a touch: outline, holes, slopes.

use super::patch::Patch;
use crate::format::root;

/// Counts over the taxels of a patch.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Outline {
    /// Number of taxels above 0.
    pub area: u32,
    /// Number of sides between a taxel above 0 and one of 0.
    pub sides: u32,
    /// Number of taxels of at least half of the peak.
    pub half_area: u32,
    /// Number of sides between a taxel of at least half of the peak and one below.
    pub half_sides: u32,
    /// Number of taxels of at least three quarters of the peak.
    pub top_area: u32,
    /// Number of taxels not below any of their eight neighbours.
    pub summits: u32,
    /// Twelve times the Euler number: parts, joined over corners, minus holes.
    pub euler12: i32,
    /// Number of taxels with a side to one of 0.
    pub rim: u32,
    /// Sum of the Sobel magnitudes / 8 on the rim, counts per taxel.
    pub slope: u64,
    /// Sum of the differences over all sides, including those to the 0 beyond the border.
    pub variation: u64,
}

impl Outline {
    /// Returns the outline of a patch whose greatest value is `peak`.
    pub fn of(patch: &Patch, peak: u16) -> Outline {
        let half = peak / 2 + peak % 2;
        let top = (u32::from(peak) * 3).div_ceil(4) as u16;
        let mut outline = Outline::default();
        patch.neighbourhoods(|around| outline.take(around, half, top));
        outline
    }

    fn take(&mut self, around: &[[u16; 3]; 3], half: u16, top: u16) {
        let [[a, b, c], [d, f, g], [h, i, j]] = *around;
        let beside = [b, d, g, i];
        let sides = beside.iter().filter(|value| **value == 0).count() as u32;
        self.area += 1;
        self.sides += sides;
        if f >= half {
            self.half_area += 1;
            self.half_sides += beside.iter().filter(|value| **value < half).count() as u32;
        }
        self.top_area += u32::from(f >= top);
        self.summits += u32::from([a, b, c, d, g, h, i, j].iter().all(|value| *value <= f));
        self.euler12 += [[b, a, d], [b, c, g], [i, h, d], [i, j, g]].iter().map(corner).sum::<i32>();
        if sides > 0 {
            self.rim += 1;
            self.slope += u64::from(magnitude(around) / 8);
        }
        // Counts each side once, from its higher end.
        let falls = beside.iter().map(|value| u64::from(f.saturating_sub(*value)));
        self.variation += falls.sum::<u64>();
    }
}

/// Returns what a touched taxel adds to twelve times the Euler number, for the square of four taxels at one
/// of its corners. Gray's sum is four times the Euler number: a square counts 1 if one of the four is
/// touched, -1 if three are, -2 if two diagonal ones are. Here the touched ones share it, in thirds.
fn corner([beside, across, other]: &[u16; 3]) -> i32 {
    match (*beside > 0, *across > 0, *other > 0) {
        (false, false, false) => 3,
        (false, true, false) => -3,
        (true, true, false) | (true, false, true) | (false, true, true) => -1,
        _ => 0,
    }
}

/// Magnitude of the Sobel gradient, rounded down.
fn magnitude(around: &[[u16; 3]; 3]) -> u32 {
    let [[a, b, c], [d, _, g], [h, i, j]] = around.map(|row| row.map(i64::from));
    let (x, y) = (c + 2 * g + j - a - 2 * d - h, h + 2 * i + j - a - 2 * b - c);
    root((x * x + y * y) as u64)
}
