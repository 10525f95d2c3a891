//! One touch as it was drawn: places and forces over time, joined by straight lines.

use super::touch::{Shape, Size};
use serde::{Deserialize, Serialize};

/// A touch that follows a path.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// Name of the panel of the path; the touch may continue across its seams.
    pub panel: String,
    /// Shape of the object.
    pub shape: Shape,
    /// Size of the footprint, mm; by default the shape's usual size.
    pub size_mm: Option<Size>,
    /// Direction of the footprint's length, degrees from +x towards +y.
    #[serde(default)]
    pub angle_deg: f64,
    /// `[t, x, y, N]`: time, s; centre, taxels; force, N. Times ascend. The touch begins at the first and ends
    /// at the last.
    pub path: Vec<[f64; 4]>,
}

impl Trace {
    /// Length and width of the footprint, mm.
    pub fn size(&self) -> [f64; 2] {
        Size::of(self.size_mm, self.shape)
    }

    /// Knots of the path.
    pub fn knots(&self) -> Vec<Knot> {
        let knot =
            |[t, x, y, n]: &[f64; 4]| Knot { t_ns: (t * 1e9).round() as u64, at: [*x, *y], force_n: *n };
        self.path.iter().map(knot).collect()
    }
}

/// Place of a path at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Time, ns.
    pub t_ns: u64,
    /// Centre, taxels of the panel.
    pub at: [f64; 2],
    /// Force, N.
    pub force_n: f64,
}

impl Knot {
    /// Returns it as in a path: `[t, x, y, N]`.
    pub fn written(&self) -> [f64; 4] {
        [self.t_ns as f64 / 1e9, self.at[0], self.at[1], self.force_n]
    }

    /// The place and the force at a time on a path: none before it; from its last knot on they stay.
    pub fn between(path: &[Knot], t_ns: u64) -> Option<Knot> {
        let next = path.partition_point(|knot| knot.t_ns <= t_ns);
        let from = *path.get(next.checked_sub(1)?)?;
        let Some(to) = path.get(next) else { return Some(Knot { t_ns, ..from }) };
        let part = (t_ns - from.t_ns) as f64 / (to.t_ns - from.t_ns) as f64;
        let way = |from: f64, to: f64| from + (to - from) * part;
        let at = [way(from.at[0], to.at[0]), way(from.at[1], to.at[1])];
        Some(Knot { t_ns, at, force_n: way(from.force_n, to.force_n) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_walked_in_straight_lines_and_written_as_it_was() {
        let path = vec![[0.2, 1.0, 2.0, 0.0], [0.216, 1.0, 2.0, 8.0], [1.216, 3.5, 1.0, 4.0]];
        let trace = Trace { panel: "a".into(), shape: Shape::Palm, size_mm: None, angle_deg: 0.0, path };
        let knots = trace.knots();
        let at = |ms: u64| Knot::between(&knots, ms * 1_000_000).map(|knot| (knot.at, knot.force_n));
        assert_eq!(at(199), None);
        assert_eq!([at(200), at(208)], [Some(([1.0, 2.0], 0.0)), Some(([1.0, 2.0], 4.0))]);
        assert_eq!([at(716), at(9_000)], [Some(([2.25, 1.5], 6.0)), Some(([3.5, 1.0], 4.0))]);
        assert_eq!(knots.iter().map(Knot::written).collect::<Vec<_>>(), trace.path);
        assert_eq!((Knot::between(&[], 5), trace.size()), (None, [100.0, 85.0]));
    }
}
