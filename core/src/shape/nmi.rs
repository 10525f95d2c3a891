//! The normalised moment of inertia (eq. 4 of the source) and its forms that do not follow pressure.
//!
//! `NMI = sqrt(J) / m` as published is immune to rotation, scale and translation, but not to pressure: with f
//! -> a f it goes as a^-1/2, and the width of the converter shifts it the same way. Two factors undo this:
//! the square root of the peak, and that of the pressure-weighted mean `sum f^2 / sum f`, which suffers less
//! from noise and coarse grids. Sheppard's correction takes the variance of the pixel itself out of the
//! moment of inertia: J - m / 6.
//!
//! Which form strays least is told by `taxel bench nmi` (one touch turned, scaled, shifted or pressed
//! harder): by peak with the correction on a fine grid, 0.4 % on 32 x 64; by sum of squares without it on a
//! block of 4 x 16, where a touch is hardly wider than the pixel whose variance the correction takes away.
//!
//! Error of every form: half a step of 2^-24, and 4e-9 of the value. Under a whole gain the forms with a
//! factor stay within twice that (both asserted against 60 digits).

use crate::contact::Moments;
use crate::format::{Fixed24, Scaled, product};
use serde::{Deserialize, Serialize};

/// The forms; all 0 where there is no pressure, all saturate just below 256.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Nmi {
    /// sqrt(J) / m, eq. 4
    pub published: Fixed24,
    /// NMI sqrt(peak): 0.39894 for a disc and 0.40825 for a square of even pressure
    pub peak: Fixed24,
    /// NMI sqrt(sum f^2 / sum f): the same for even pressure
    pub s2: Fixed24,
    /// as `peak`, with Sheppard's correction
    pub peak_sheppard: Fixed24,
    /// as `s2`, with Sheppard's correction
    pub s2_sheppard: Fixed24,
}

/// All forms of a contact or an image whose greatest value is `peak`. Total: 0 for no pressure, and just
/// below 256 for what would be more (few counts very far apart). For moments that wrapped, or another peak,
/// the result means nothing.
pub fn nmi(moments: &Moments, peak: u16) -> Nmi {
    if moments.m == 0 {
        return Nmi::default();
    }
    // One division: the rest is multiplications by the inverse of the mass, and roots.
    let inverse = Scaled::from_u64(1).over(Scaled::from_u64(moments.m));
    let jm = moments.jm();
    let published = Scaled::from_u64(jm).times(inverse).sqrt().times(inverse);
    let sheppard = sheppard(jm, moments.m).times(inverse).sqrt().times(inverse);
    let peak = Scaled::from_u64(peak.into()).sqrt();
    let mean = Scaled::from_u64(moments.s2).times(inverse).sqrt();
    Nmi {
        published: published.to_fixed24(),
        peak: published.times(peak).to_fixed24(),
        s2: published.times(mean).to_fixed24(),
        peak_sheppard: sheppard.times(peak).to_fixed24(),
        s2_sheppard: sheppard.times(mean).to_fixed24(),
    }
}

const SIXTH: Scaled = Scaled::from_u64(1).over(Scaled::from_u64(6));

/// `J m - m^2 / 6` through `6 J m - m^2`, which is exact where it fits; 0 where the pixel is all there is.
pub(super) fn sheppard(jm: u64, m: u64) -> Scaled {
    let square = if m >> 32 == 0 { product(m, m) } else { u64::MAX };
    if jm <= u64::MAX / 6 {
        let six = (jm << 2) + (jm << 1);
        Scaled::from_u64(six.saturating_sub(square)).times(SIXTH)
    } else {
        Scaled::from_u64(jm.saturating_sub(square / 6))
    }
}
