//! Contacts for the comparison of number formats: eight windows of 16 x 16 taxels, each with an elongated
//! dome.

use crate::chain::TAXELS;
use crate::pattern::{UNITS, hash};
use taxel_core::format::Code;

/// Number of rows, and of columns, of a window.
pub const SIDE: usize = 16;
/// Number of taxels of a window.
pub const AREA: usize = SIDE * SIDE;
/// Number of windows of a round.
pub const WINDOWS: usize = TAXELS / AREA;

/// Fills all windows: domes of pressure `p (1 - (u / a)^2 - (v / b)^2)` with random place, direction, lengths
/// (a to 7 taxels, b 0.3 to 0.7 of it) and peaks from 100 to 4095 counts.
pub fn fill(round: u32, values: &mut [Code; TAXELS]) {
    for (number, window) in values.chunks_mut(AREA).enumerate() {
        let random = |salt: u32, from: i64, to: i64| {
            let bits = hash(round * WINDOWS as u32 + number as u32, 1000 + salt);
            from + i64::from(bits) % (to - from + 1)
        };
        let unit = i64::from(UNITS);
        let centre = [random(0, 130, 170), random(1, 130, 170)];
        let (along, across) = (random(2, -7, 7), random(3, 1, 7));
        let a = random(4, 3 * unit, 7 * unit);
        let b = a * random(5, 30, 70) / 100;
        let peak = random(6, 100, 4095);
        for (taxel, code) in window.iter_mut().enumerate() {
            let x = (taxel % SIDE) as i64 * unit - centre[0];
            let y = (taxel / SIDE) as i64 * unit - centre[1];
            let (u, v) = (x * along + y * across, y * along - x * across);
            // (u / a)^2 + (v / b)^2 = top / whole
            let whole = a * a * b * b * (along * along + across * across);
            let top = u * u * b * b + v * v * a * a;
            code.0 = (peak * (whole - top).max(0) / whole) as u16;
        }
    }
}
