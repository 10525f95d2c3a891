//! Distribution of a contact's force over the taxels.
//!
//! A taxel feels the force on its cell, the rectangle of one pitch around its centre. Cells tile the panel,
//! so the shares of all taxels add up to 1 wherever the footprint is, without normalisation per frame.

use super::touch::Shape;
use libm::{hypot, sin, sincos};
use std::f64::consts::PI;

/// Steps of the footprint's grid per taxel.
const STEPS: usize = 8;

/// Most nodes of a footprint's grid: 250 taxels in a square.
const MOST_NODES: usize = 4_000_000;

/// Share of a contact's force on a taxel, by the taxel's offset from the contact's centre.
#[derive(Debug, Clone)]
pub struct Footprint {
    /// Shares on a grid of 1/8 taxel, row by row; zero along the border.
    shares: Vec<f32>,
    columns: usize,
    rows: usize,
}

impl Footprint {
    /// A footprint of `size_mm` (length, width), with its length turned by `angle_deg` from +x towards +y, on
    /// a panel with this pitch. Sizes and pitches must be positive.
    pub fn build(shape: Shape, size_mm: [f64; 2], angle_deg: f64, pitch_mm: [f64; 2]) -> Footprint {
        let half = [size_mm[0] / 2.0, size_mm[1] / 2.0];
        let step = [pitch_mm[0] / STEPS as f64, pitch_mm[1] / STEPS as f64];
        let [nx, ny] = nodes(shape, half, angle_deg, step);
        let (columns, rows) = (2 * nx + 1, 2 * ny + 1);
        let (sin, cos) = sincos(angle_deg.to_radians());
        let mut dense = vec![0.0f64; columns * rows];
        for (index, value) in dense.iter_mut().enumerate() {
            let x = ((index % columns) as f64 - nx as f64) * step[0];
            let y = ((index / columns) as f64 - ny as f64) * step[1];
            *value = pressure(shape, half, x * cos + y * sin, y * cos - x * sin);
        }
        let total: f64 = dense.iter().sum();
        let cells = over_cells(&over_cells(&dense, columns, rows, 1), columns, rows, columns);
        let shares = cells.iter().map(|value| (value / total) as f32).collect();
        Footprint { shares, columns, rows }
    }

    /// Share of the force on a taxel whose centre is `dx`, `dy` taxels from the contact's centre.
    pub fn share(&self, dx: f32, dy: f32) -> f32 {
        let x = dx * STEPS as f32 + (self.columns / 2) as f32;
        let y = dy * STEPS as f32 + (self.rows / 2) as f32;
        if !(x >= 0.0 && y >= 0.0) {
            return 0.0;
        }
        let (left, top) = (x as usize, y as usize);
        if left + 1 >= self.columns || top + 1 >= self.rows {
            return 0.0;
        }
        let first = top * self.columns + left;
        let (Some([a, b, ..]), Some([c, d, ..])) = (
            self.shares.get(first..first + 2),
            self.shares.get(first + self.columns..first + self.columns + 2),
        ) else {
            return 0.0;
        };
        let (u, v) = (x - left as f32, y - top as f32);
        let upper = a + (b - a) * u;
        upper + (c + (d - c) * u - upper) * v
    }

    /// Distance from the centre beyond which no taxel has a share, in taxels along x and y.
    pub fn reach(&self) -> [f64; 2] {
        [self.columns, self.rows].map(|nodes| (nodes / 2) as f64 / STEPS as f64)
    }
}

/// True if the grid of the footprint has more than [`MOST_NODES`] nodes, because it is large or the pitch
/// fine.
pub(super) fn is_too_fine(shape: Shape, size_mm: [f64; 2], angle_deg: f64, pitch_mm: [f64; 2]) -> bool {
    let half = size_mm.map(|size| size / 2.0);
    let [nx, ny] = nodes(shape, half, angle_deg, pitch_mm.map(|pitch| pitch / STEPS as f64));
    (2 * nx + 1).saturating_mul(2 * ny + 1) > MOST_NODES
}

/// Nodes on each side of the centre: the footprint, half a taxel for the taxel's cell, a border.
fn nodes(shape: Shape, half: [f64; 2], angle_deg: f64, step: [f64; 2]) -> [usize; 2] {
    let reach = reach_mm(shape, half, angle_deg);
    [0, 1].map(|axis| (reach[axis] / step[axis]).ceil() as usize + STEPS / 2 + 1)
}

/// Sums over the cell of a taxel along one axis; both ends of the cell have half the weight, so that cells
/// tile the axis.
fn over_cells(values: &[f64], columns: usize, rows: usize, stride: usize) -> Vec<f64> {
    let (length, position): (usize, fn(usize, usize) -> usize) =
        if stride == 1 { (columns, |i, c| i % c) } else { (rows, |i, c| i / c) };
    let half = STEPS / 2;
    (0..values.len())
        .map(|index| {
            let at = position(index, columns);
            (0..=STEPS)
                .filter(|k| (half..length + half).contains(&(at + k)))
                .map(|k| {
                    let weight = if k == 0 || k == STEPS { 0.5 } else { 1.0 };
                    weight * values.get(index + k * stride - half * stride).copied().unwrap_or(0.0)
                })
                .sum()
        })
        .collect()
}

/// Width of the soft edge, mm.
const fn edge_mm(shape: Shape) -> f64 {
    match shape {
        Shape::Palm => 16.0,
        Shape::Strap => 4.0,
        Shape::Box => 3.0,
        Shape::Forearm | Shape::Ridge => 10.0,
        Shape::Finger | Shape::Ball | Shape::Plate => 0.0,
    }
}

/// Half the width and height of the bounding box of the turned footprint, mm.
pub(super) fn reach_mm(shape: Shape, half: [f64; 2], angle_deg: f64) -> [f64; 2] {
    let (sin, cos) = sincos(angle_deg.to_radians());
    let [length, width] = half.map(|h| h + edge_mm(shape) / 2.0);
    [(length * cos).abs() + (width * sin).abs(), (length * sin).abs() + (width * cos).abs()]
}

/// Pressure at `u` along and `v` across the footprint (mm from its centre), in no particular unit.
fn pressure(shape: Shape, half: [f64; 2], u: f64, v: f64) -> f64 {
    let [length, width] = half;
    let square = |part: f64| part * part;
    let dome = |r2: f64| (1.0 - r2).max(0.0).sqrt();
    match shape {
        Shape::Finger | Shape::Ball => dome(square(u / length) + square(v / width)),
        Shape::Forearm | Shape::Ridge => dome(square(v / width)) * soft(u.abs() - length, edge_mm(shape)),
        Shape::Strap | Shape::Box => soft(outside(half, 0.0, u, v), edge_mm(shape)),
        Shape::Plate => inside(u, length) * inside(v, width),
        Shape::Palm => soft(outside(half, 0.4 * length.min(width), u, v), edge_mm(shape)),
    }
}

/// 1 inside, 0.5 on the edge, 0 outside, along one axis.
fn inside(at: f64, half: f64) -> f64 {
    let beyond = at.abs() - half;
    if beyond.abs() < 1e-6 { 0.5 } else { f64::from(beyond < 0.0) }
}

/// Distance outside a rectangle with rounded corners, negative inside, mm.
fn outside(half: [f64; 2], corner: f64, u: f64, v: f64) -> f64 {
    let (a, b) = (u.abs() - half[0] + corner, v.abs() - half[1] + corner);
    hypot(a.max(0.0), b.max(0.0)) + a.max(b).min(0.0) - corner
}

/// 1 well inside, 0 well outside, half a cosine across an edge of this width.
fn soft(outside: f64, width: f64) -> f64 {
    0.5 - 0.5 * sin(PI * (outside / width).clamp(-0.5, 0.5))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PITCH: [f64; 2] = [12.0, 10.0];
    const SHAPES: [Shape; 7] =
        [Shape::Palm, Shape::Strap, Shape::Box, Shape::Finger, Shape::Ball, Shape::Forearm, Shape::Ridge];

    /// Sums of share, share x, share y, share x^2, share y^2 over the taxels around a contact at (cx, cy), in
    /// mm.
    fn sums(footprint: &Footprint, cx: f64, cy: f64) -> [f64; 5] {
        let mut sums = [0.0; 5];
        for (y, x) in (-40..=40).flat_map(|y| (-40..=40).map(move |x| (y, x))) {
            let share = f64::from(footprint.share((f64::from(x) - cx) as f32, (f64::from(y) - cy) as f32));
            let (x, y) = ((f64::from(x) - cx) * PITCH[0], (f64::from(y) - cy) * PITCH[1]);
            for (sum, term) in sums.iter_mut().zip([1.0, x, y, x * x, y * y]) {
                *sum += share * term;
            }
        }
        sums
    }

    /// Means of the sums over all positions of the centre within a taxel: what a panel sees on average.
    fn mean_sums(footprint: &Footprint) -> [f64; 5] {
        let mut mean = [0.0; 5];
        for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (f64::from(i), f64::from(j)))) {
            for (mean, sum) in mean.iter_mut().zip(sums(footprint, i / 8.0, j / 8.0)) {
                *mean += sum / 64.0;
            }
        }
        mean
    }

    #[test]
    fn the_shares_of_every_shape_add_up_to_one_anywhere() {
        let mut rng = fastrand::Rng::with_seed(1);
        for shape in SHAPES {
            for angle in [0.0, 30.0, 90.0, -77.0] {
                let footprint = Footprint::build(shape, shape.usual_mm(), angle, PITCH);
                for _ in 0..5 {
                    let [sum, x, y, ..] = sums(&footprint, rng.f64(), rng.f64());
                    assert!((sum - 1.0).abs() < 1e-5, "{shape:?} at {angle}: {sum}");
                    // With taxels of 12 mm, an object of 16 mm cannot be located better.
                    assert!(x.abs() < 1.2 && y.abs() < 1.2, "{shape:?}: centre off by {x}, {y} mm");
                }
            }
        }
    }

    #[test]
    fn sizes_are_true() {
        // A rectangle of length a has variance a^2 / 12 along it, a taxel's cell adds pitch^2 / 12.
        let strap = Footprint::build(Shape::Strap, [200.0, 20.0], 90.0, PITCH);
        let [_, x, y, xx, yy] = mean_sums(&strap);
        assert!(x.abs() < 1e-3 && y.abs() < 1e-3);
        assert!(((xx - 144.0 / 12.0) / (400.0 / 12.0) - 1.0).abs() < 0.05, "{xx}");
        assert!(((yy - 100.0 / 12.0) / (40_000.0 / 12.0) - 1.0).abs() < 0.01, "{yy}");
        // A Hertz patch of radius a has variance a^2 / 5.
        let ball = Footprint::build(Shape::Ball, [80.0, 80.0], 0.0, PITCH);
        let [_, _, _, xx, yy] = mean_sums(&ball);
        assert!(((xx - 12.0) / 320.0 - 1.0).abs() < 0.01, "{xx}");
        assert!(((yy - 100.0 / 12.0) / 320.0 - 1.0).abs() < 0.01, "{yy}");
    }

    #[test]
    fn a_footprint_ends_at_its_reach() {
        for shape in SHAPES {
            let footprint = Footprint::build(shape, shape.usual_mm(), 25.0, PITCH);
            let [x, y] = footprint.reach().map(|r| r as f32);
            for t in -50..50 {
                let t = t as f32 / 3.0;
                assert_eq!([footprint.share(x, t), footprint.share(-x, t)], [0.0; 2], "{shape:?}");
                assert_eq!([footprint.share(t, y), footprint.share(t, -y)], [0.0; 2], "{shape:?}");
            }
            assert_eq!(footprint.share(f32::NAN, 0.0), 0.0);
        }
    }
}
