//! A hardness cue: the rise of the force over the rise of the area, while a contact grows.
//!
//! | | |
//! |---|---|
//! | input | force (counts) and area (taxels) of one contact, frame after frame |
//! | output | counts per cm2, rounded down; and a word for it |
//! | saturation | at 2^32 - 1 |
//! | latency | none; the cue is unknown until the force is twice that of the first frame |
//! | RAM | [`HardnessCue`]: 20 bytes a contact |
//! | M0+ cycles | 30 a frame, and a 32-bit division when the cue is read |
//!
//! A soft object wraps around what it touches, so that force and area grow together; a hard one keeps its
//! outline, and only the force grows. For a ball of radius R in Hertz' contact (Johnson, Contact Mechanics,
//! 1985, 4.2) the patch has radius a, the force is 4/3 E a^3 / R, and dF/dA = 2 E a / (pi R): proportional to
//! the common modulus E of both. So the cue compares objects of one shape: a sharper object of the same
//! material also seems harder. A contact that never has more taxels than in its first frame counts as grown
//! by one taxel: this is the greatest hardness that the garment can measure.

use core::num::NonZeroU32;
use serde::{Deserialize, Serialize};

/// Cue below which an object is soft, counts per cm2. At 1,000 counts per newton, such a contact grows by
/// more than 1 cm2 for each further newton (10 kPa).
pub const SOFT: u32 = 1_000;
/// Cue from which an object is hard, counts per cm2.
pub const HARD: u32 = 4_000;

/// Force and area of a contact in its first frame, and in the frame of its greatest force.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct HardnessCue {
    first: Option<(u32, u16)>,
    greatest: (u32, u16),
}

impl HardnessCue {
    /// Takes the next frame of the contact. A force that is not greater than all before changes nothing.
    pub fn feel(&mut self, force: u32, area: u16) {
        if self.first.is_none() || force > self.greatest.0 {
            self.greatest = (force, area);
        }
        self.first.get_or_insert((force, area));
    }

    /// Greatest force of the contact so far, counts.
    pub const fn greatest_force(&self) -> u32 {
        self.greatest.0
    }

    /// Returns the rise of the force over the rise of the area, counts per cm2; a taxel has `cell_mm2`
    /// ([`cell_mm2`](crate::garment::cell_mm2)). None before the force has doubled. Does not panic.
    pub fn hardness(&self, cell_mm2: u32) -> Option<u32> {
        let (force, area) = self.first?;
        let rise = self.greatest.0.checked_sub(force).filter(|rise| *rise >= force.max(1))?;
        let spread = u32::from(self.greatest.1.saturating_sub(area).max(1));
        let cells = NonZeroU32::new(spread.saturating_mul(cell_mm2.max(1)))?;
        Some(rise.saturating_mul(100) / cells)
    }
}

/// Class of a hardness cue. Variants are only appended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Hardness {
    /// Below [`SOFT`].
    Soft,
    /// From [`SOFT`] to below [`HARD`].
    Firm,
    /// From [`HARD`] on.
    Hard,
}

impl Hardness {
    /// Returns the class of a cue in counts per cm2.
    pub const fn of(cue: u32) -> Hardness {
        match cue {
            0..SOFT => Hardness::Soft,
            SOFT..HARD => Hardness::Firm,
            HARD.. => Hardness::Hard,
        }
    }

    /// Name in lower case.
    pub const fn as_str(self) -> &'static str {
        match self {
            Hardness::Soft => "soft",
            Hardness::Firm => "firm",
            Hardness::Hard => "hard",
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::garment::cell_mm2;

    /// A taxel of 1 cm2.
    const CM: u32 = 100;

    fn felt(frames: &[(u32, u16)]) -> HardnessCue {
        let mut cue = HardnessCue::default();
        frames.iter().for_each(|(force, area)| cue.feel(*force, *area));
        cue
    }

    #[test]
    fn it_is_the_rise_of_the_force_over_that_of_the_area() {
        let soft = felt(&[(200, 4), (900, 12), (5_200, 24), (4_000, 30), (100, 1)]);
        assert_eq!(soft.hardness(CM), Some(5_000 / 20));
        assert_eq!(Hardness::of(250), Hardness::Soft);
        let hard = felt(&[(200, 6), (5_200, 6)]);
        assert_eq!(hard.hardness(CM), Some(5_000), "no taxel more counts as one");
        assert_eq!(Hardness::of(5_000).as_str(), "hard");
        let shrinking = felt(&[(200, 6), (5_200, 3)]);
        assert_eq!(shrinking.hardness(CM), Some(5_000));
    }

    #[test]
    fn the_unit_does_not_depend_on_the_pitch() {
        // The same patch on taxels of 5 mm and of 10 mm by 12 mm.
        assert_eq!(felt(&[(1_000, 8), (6_000, 88)]).hardness(cell_mm2([5_000, 5_000])), Some(250));
        assert_eq!(felt(&[(1_000, 8), (7_000, 18)]).hardness(cell_mm2([10_000, 12_000])), Some(500));
        assert_eq!(
            felt(&[(1_000, 8), (7_000, 18)]).hardness(cell_mm2([0, 0])),
            Some(600),
            "10 mm are assumed"
        );
    }

    #[test]
    fn what_has_not_doubled_is_not_known() {
        assert_eq!(felt(&[]).hardness(CM), None);
        assert_eq!(felt(&[(500, 4)]).hardness(CM), None);
        assert_eq!(felt(&[(500, 4), (999, 5), (300, 2)]).hardness(CM), None);
        assert_eq!(felt(&[(500, 4), (1_000, 5)]).hardness(CM), Some(500));
        assert_eq!(felt(&[(0, 0), (0, 0)]).hardness(CM), None);
    }

    #[test]
    fn extremes_are_bounded() {
        assert_eq!(felt(&[(1, 0), (u32::MAX, 0)]).hardness(cell_mm2([1, 1])), Some(u32::MAX));
        assert_eq!(felt(&[(1, 0), (u32::MAX, u16::MAX)]).hardness(cell_mm2([u32::MAX; 2])), Some(1));
        assert_eq!(felt(&[(0, 0), (1, u16::MAX)]).hardness(CM), Some(0));
    }

    /// Hertz: a = (3 F R / 4 E)^(1/3), and the area is pi a^2. Compares the cue between two forces with the
    /// exact quotient.
    #[test]
    fn balls_of_hertz_are_ordered_by_their_modulus() {
        let area = |newton: f64, kpa: f64| {
            let a_mm = (3.0 * newton * 50.0 / (4.0 * kpa * 1e-3)).cbrt();
            core::f64::consts::PI * a_mm * a_mm / 4.0 // taxels of 2 mm
        };
        let mut last = 0;
        for kpa in [50.0, 200.0, 800.0, 3_200.0] {
            let forces = [1.0, 2.0, 5.0, 10.0, 20.0];
            let mut cue = HardnessCue::default();
            for newton in forces {
                cue.feel((newton * 1_000.0) as u32, area(newton, kpa).round() as u16);
            }
            let cue = cue.hardness(cell_mm2([2_000, 2_000])).unwrap();
            let exact = 19_000.0 / (area(20.0, kpa) - area(1.0, kpa)) * 25.0;
            assert!((f64::from(cue) / exact - 1.0).abs() < 0.02, "{kpa} kPa: {cue} for {exact}");
            assert!(cue > 2 * last, "four times the modulus: {last}, {cue}");
            last = cue;
        }
    }
}
