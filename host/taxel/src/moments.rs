//! Moments, NMI and axis of one image, without conditioning or thresholds.

use crate::error::{ArrayError, Result};
use serde::Serialize;
use taxel_core::contact::{Moments, axis};
use taxel_core::format::Turn;
use taxel_core::shape::nmi;

/// Features of one image. The sums are exact; x is the column and y the row, from 0. Features that need
/// pressure are none for an image without any.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Features {
    /// sum f
    pub m: u64,
    /// sum x f
    pub sx: i64,
    /// sum y f
    pub sy: i64,
    /// sum x^2 f
    pub sxx: u64,
    /// sum y^2 f
    pub syy: u64,
    /// sum x y f
    pub sxy: i64,
    /// Moment of inertia about the centroid, times the mass.
    #[serde(rename = "Jm")]
    pub jm: u64,
    /// Normalised moment of inertia as published, sqrt(J) / m.
    pub nmi: Option<f64>,
    /// nmi sqrt(peak)
    pub nmi_peak: Option<f64>,
    /// nmi sqrt(sum f^2 / sum f)
    pub nmi_s2: Option<f64>,
    /// `nmi_peak` with Sheppard's correction.
    pub nmi_peak_sheppard: Option<f64>,
    /// `nmi_s2` with Sheppard's correction.
    pub nmi_s2_sheppard: Option<f64>,
    /// Angle of the major axis from +x towards +y, in (-pi/2, pi/2] rad; none for an image without direction.
    pub azimuth_rad: Option<f64>,
    /// 0 for a disc or square, 1 for a line.
    pub anisotropy: Option<f64>,
    /// Centroid along the columns, taxels from the first column.
    pub column: Option<f64>,
    /// Centroid along the rows, taxels from the first row.
    pub row: Option<f64>,
    /// Number of taxels with pressure.
    pub area: u32,
    /// Greatest value.
    pub peak: u16,
}

impl Features {
    /// Computes the features of an image with rows of `columns` values. Error if the moment of inertia times
    /// mass exceeds 64 bits, for which the core's arithmetic is not exact.
    pub fn of(image: &[u16], columns: usize) -> Result<Features> {
        let moments = Moments::of_image(image, columns);
        if wide_jm(&moments) != Some(moments.jm().into()) {
            fail!(
                ArrayError::TooLarge,
                "the image is too large and too bright: its J m takes more than 64 bits"
            );
        }
        let peak = image.iter().copied().max().unwrap_or(0);
        let area = image.iter().filter(|value| **value > 0).count() as u32;
        let forms = nmi(&moments, peak);
        let axis = axis(&moments.central(), area);
        let m = moments.m;
        let some = |value: f64| (m > 0).then_some(value);
        Ok(Features {
            m,
            sx: moments.sx,
            sy: moments.sy,
            sxx: moments.sxx,
            syy: moments.syy,
            sxy: moments.sxy,
            jm: moments.jm(),
            nmi: some(forms.published.to_f64()),
            nmi_peak: some(forms.peak.to_f64()),
            nmi_s2: some(forms.s2.to_f64()),
            nmi_peak_sheppard: some(forms.peak_sheppard.to_f64()),
            nmi_s2_sheppard: some(forms.s2_sheppard.to_f64()),
            azimuth_rad: axis.azimuth.map(Turn::to_radians),
            anisotropy: some(axis.anisotropy.to_f64()),
            column: some(moments.sx as f64 / m as f64),
            row: some(moments.sy as f64 / m as f64),
            area,
            peak,
        })
    }
}

/// `m (sxx + syy) - sx^2 - sy^2` without wrapping.
fn wide_jm(moments: &Moments) -> Option<i128> {
    let [m, sxx, syy] = [moments.m, moments.sxx, moments.syy].map(i128::from);
    let [sx, sy] = [moments.sx, moments.sy].map(i128::from);
    m.checked_mul(sxx + syy)?.checked_sub(sx * sx)?.checked_sub(sy * sy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_features() {
        // Three rows of five columns, the middle row pressed with 4.
        let image: Vec<u16> = (0..15).map(|i| if (5..10).contains(&i) { 4 } else { 0 }).collect();
        let have = Features::of(&image, 5).unwrap();
        let sums = (have.m, have.sx, have.sy, have.sxx, have.syy, have.sxy, have.jm);
        assert_eq!(sums, (20, 40, 20, 120, 20, 40, 800));
        assert_eq!((have.column, have.row, have.area, have.peak), (Some(2.0), Some(1.0), 5, 4));
        assert_eq!((have.azimuth_rad, have.anisotropy), (Some(0.0), Some(1.0)));
        // sqrt(40) / 20, and times sqrt(4) for even pressure.
        assert!((have.nmi.unwrap() - 0.1f64.sqrt()).abs() < 6e-8);
        assert!((have.nmi_peak.unwrap() - 2.0 * 0.1f64.sqrt()).abs() < 6e-8);
        assert_eq!(have.nmi_peak, have.nmi_s2);
    }

    #[test]
    fn an_image_without_pressure_has_no_place() {
        let have = Features::of(&[0; 12], 4).unwrap();
        assert_eq!((have.m, have.jm, have.nmi, have.azimuth_rad, have.column), (0, 0, None, None, None));
        let json = serde_json::to_value(&have).unwrap();
        assert!(json["nmi"].is_null() && json["column"].is_null() && json["Jm"] == 0);
    }

    #[test]
    fn what_is_not_exact_is_refused() {
        assert!(Features::of(&vec![u16::MAX; 64 * 64], 64).is_err());
        assert!(Features::of(&vec![u16::MAX; 64 * 32], 32).is_ok());
    }
}
