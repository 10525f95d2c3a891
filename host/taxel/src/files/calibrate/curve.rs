//! A piecewise linear curve from counts to newtons on a taxel, in integers.

use crate::error::{Result, SettingError};
use serde::{Deserialize, Serialize};

/// Fractions of a count in a knot.
pub const PARTS: u32 = 16;

/// A point of the curve: `[1/16 count, uN]`.
pub type Knot = [u32; 2];

/// A curve through the origin that rises from knot to knot, and continues straight after the last.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Curve(Vec<Knot>);

impl Curve {
    /// A curve through knots that rise in both coordinates.
    pub fn new(knots: Vec<Knot>) -> Result<Curve> {
        require!(!knots.is_empty(), SettingError::Calibration, "a curve needs at least one knot");
        let rises = |at: usize| [&[[0, 0]], knots.as_slice()].concat().is_sorted_by(|a, b| a[at] < b[at]);
        require!(rises(0), SettingError::Calibration, "the counts of a curve's knots must rise from above 0");
        require!(rises(1), SettingError::Calibration, "the forces of a curve's knots must rise from above 0");
        Ok(Curve(knots))
    }

    /// A curve through mean counts and uN on a taxel, in rising order of force. Where noise makes the counts
    /// fall, neighbouring points are merged.
    pub fn through(points: &[[f64; 2]]) -> Result<Curve> {
        // Means of x and y, and the number of points.
        let mut groups: Vec<[f64; 3]> = Vec::new();
        for [x, y] in points {
            let mut group = [x * f64::from(PARTS), *y, 1.0];
            while let Some(last) = groups.pop_if(|last| last[0] + 1.0 > group[0]) {
                let count = last[2] + group[2];
                let mean = |at: usize| (last[at] * last[2] + group[at] * group[2]) / count;
                group = [mean(0), mean(1), count];
            }
            groups.push(group);
        }
        Curve::new(groups.iter().map(|[x, y, _]| [x.round() as u32, y.round() as u32]).collect())
    }

    /// The knots.
    pub fn knots(&self) -> &[Knot] {
        &self.0
    }

    /// Force on a taxel with this many 1/16 counts, uN.
    pub fn micronewtons(&self, parts: u32) -> u64 {
        let after = self.0.partition_point(|[x, _]| *x <= parts).min(self.0.len() - 1);
        let [x0, y0] = after.checked_sub(1).map_or([0, 0], |before| self.0[before]);
        let [x1, y1] = self.0[after];
        u64::from(y0) + u64::from(parts - x0) * u64::from(y1 - y0) / u64::from(x1 - x0)
    }

    /// Counts per newton between the origin and the last knot.
    pub fn counts_per_newton(&self) -> f64 {
        let [x, y] = self.0[self.0.len() - 1];
        f64::from(x) / f64::from(PARTS) / (f64::from(y) / 1e6)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_straight_from_knot_to_knot_and_on() {
        let curve = Curve::new(vec![[160, 10_000], [480, 40_000]]).unwrap();
        let at = |counts: u32| curve.micronewtons(counts * PARTS);
        assert_eq!(
            [at(0), at(5), at(10), at(20), at(30), at(50)],
            [0, 5_000, 10_000, 25_000, 40_000, 70_000]
        );
        assert!((curve.counts_per_newton() - 750.0).abs() < 1e-9);
        let rising = (0..65_536).map(|parts| curve.micronewtons(parts));
        assert!(rising.is_sorted());
    }

    #[test]
    fn points_that_fall_are_put_together() {
        let curve = Curve::through(&[[10.0, 1e4], [30.0, 2e4], [28.0, 3e4], [50.0, 4e4]]).unwrap();
        assert_eq!(curve.knots(), [[160, 10_000], [464, 25_000], [800, 40_000]]);
        assert!(Curve::through(&[]).is_err());
        assert!(Curve::new(vec![[16, 5], [16, 6]]).unwrap_err().to_string().contains("counts"));
        assert!(Curve::new(vec![[16, 0]]).unwrap_err().to_string().contains("forces"));
    }
}
