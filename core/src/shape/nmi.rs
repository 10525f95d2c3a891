//! The normalised moment of inertia (eq. 4 of the source) and its forms that do not depend on pressure.
//!
//! `NMI = sqrt(J) / m` as published is invariant to rotation, scale and translation, but not to pressure:
//! with f -> a f it changes by a^-1/2, and so it does with the width of the converter. Either of two factors
//! undoes this: the square root of the peak, or that of the pressure-weighted mean `sum f^2 / sum f`, which
//! suffers less from noise and coarse grids. Sheppard's correction removes the variance of the pixel itself
//! from the moment of inertia: J - m / 6.
//!
//! `cargo xtask bench nmi` measures which form varies least (one touch turned, scaled, shifted or pressed
//! harder).
//! On a fine grid it is the form by peak with the correction: 0.4 % on 32 x 64. On a block of 4 x 16 it is
//! the form by sum of squares without it, because a touch is hardly wider than the pixel whose variance the
//! correction removes.
//!
//! Error of every form: half a step of 2^-24, and 4e-9 of the value. Under an integer gain the forms with a
//! factor stay within twice that (both asserted against 60 digits).

use crate::contact::Moments;
use crate::format::{Fixed24, Scaled, product};
use serde::{Deserialize, Serialize};

/// Forms of the NMI; all 0 without pressure, all saturate just below 256.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Nmi {
    /// sqrt(J) / m, eq. 4
    pub published: Fixed24,
    /// NMI sqrt(peak): 0.39894 for a disc and 0.40825 for a square of even pressure
    pub peak: Fixed24,
    /// NMI sqrt(sum f^2 / sum f): equal to `peak` for even pressure
    pub s2: Fixed24,
    /// `peak` with Sheppard's correction
    pub peak_sheppard: Fixed24,
    /// `s2` with Sheppard's correction
    pub s2_sheppard: Fixed24,
}

/// Returns all forms for a contact or an image whose greatest value is `peak`. Never panics: 0 without
/// pressure, and just below 256 for greater values (few counts very far apart). For moments that wrapped, or
/// another peak, the result has no meaning.
pub fn nmi(moments: &Moments, peak: u16) -> Nmi {
    if moments.m == 0 {
        return Nmi::default();
    }
    // One division; the rest is multiplications by the inverse of the mass, and roots.
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

/// Returns `J m - m^2 / 6` through `6 J m - m^2`, which is exact where it fits; 0 if the pixel's variance is
/// all.
pub(super) fn sheppard(jm: u64, m: u64) -> Scaled {
    let square = if m >> 32 == 0 { product(m, m) } else { u64::MAX };
    if jm <= u64::MAX / 6 {
        let six = (jm << 2) + (jm << 1);
        Scaled::from_u64(six.saturating_sub(square)).times(SIXTH)
    } else {
        Scaled::from_u64(jm.saturating_sub(square / 6))
    }
}
