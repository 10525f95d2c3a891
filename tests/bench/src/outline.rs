//! Outlines of touches, and the covered part of each taxel: exact areas of polygons, no sampling.

use std::f64::consts::PI;

/// Corners of a polygon for a circle: its edge is off by less than 5e-6 of the radius.
const CORNERS: usize = 1024;

type Point = [f64; 2];

/// A convex polygon, in taxels.
#[derive(Debug, Clone)]
pub struct Outline(Vec<Point>);

impl Outline {
    /// A disc around the origin.
    pub fn disc(radius: f64) -> Outline {
        Outline::capsule(0.0, radius)
    }

    /// A rectangle around the origin, by its half sides.
    pub fn rectangle(half_length: f64, half_width: f64) -> Outline {
        let [x, y] = [half_length, half_width];
        Outline(vec![[x, y], [-x, y], [-x, -y], [x, -y]])
    }

    /// A rectangle with this half length between two half discs.
    pub fn capsule(half_length: f64, radius: f64) -> Outline {
        let corner = |index: usize| {
            let (y, x) = ((index as f64 + 0.5) / CORNERS as f64 * 2.0 * PI).sin_cos();
            [x * radius + half_length.copysign(x), y * radius]
        };
        Outline((0..CORNERS).map(corner).collect())
    }

    /// The outline turned about the origin (radians, from +x towards +y), then moved.
    pub fn placed(&self, angle: f64, [x, y]: Point) -> Outline {
        let (sin, cos) = angle.sin_cos();
        Outline(self.0.iter().map(|[u, v]| [u * cos - v * sin + x, u * sin + v * cos + y]).collect())
    }

    /// Adds `weight` times the covered part of each taxel to an image of rows of `columns` taxels.
    pub fn cover(&self, weight: f64, columns: usize, image: &mut [f64]) {
        for (row, taxels) in image.chunks_mut(columns).enumerate() {
            let strip = between(&self.0, 1, row as f64);
            if strip.is_empty() {
                continue;
            }
            for (column, taxel) in taxels.iter_mut().enumerate() {
                *taxel += weight * area(&between(&strip, 0, column as f64));
            }
        }
    }
}

/// Part of a polygon within half a taxel of a coordinate along an axis (0: x, 1: y).
fn between(polygon: &[Point], axis: usize, centre: f64) -> Vec<Point> {
    cut(&cut(polygon, axis, 1.0, centre + 0.5), axis, -1.0, 0.5 - centre)
}

/// Part of a convex polygon with `sign * coordinate <= limit`.
fn cut(polygon: &[Point], axis: usize, sign: f64, limit: f64) -> Vec<Point> {
    let beyond = |point: &Point| sign * point[axis] - limit;
    let mut rest = Vec::with_capacity(polygon.len() + 2);
    for (index, point) in polygon.iter().enumerate() {
        let next = &polygon[(index + 1) % polygon.len()];
        let (here, there) = (beyond(point), beyond(next));
        if here <= 0.0 {
            rest.push(*point);
        }
        if here * there < 0.0 {
            let share = here / (here - there);
            rest.push([0, 1].map(|axis| point[axis] + share * (next[axis] - point[axis])));
        }
    }
    rest
}

/// Area of a polygon whose corners go from +x towards +y, relative to one of them for precision.
fn area(polygon: &[Point]) -> f64 {
    let Some([x, y]) = polygon.first() else { return 0.0 };
    let cross = |pair: &[Point]| (pair[0][0] - x) * (pair[1][1] - y) - (pair[1][0] - x) * (pair[0][1] - y);
    polygon.windows(2).map(cross).sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(outline: &Outline) -> Vec<f64> {
        let mut image = vec![0.0; 16 * 16];
        outline.cover(1.0, 16, &mut image);
        image
    }

    #[test]
    fn taxels_are_covered_by_their_exact_part() {
        // From x 2.25 to 4.75 and y 2.5 to 3.5: 0.25, 1, 1, 0.25 of a row.
        let covered = image(&Outline::rectangle(1.25, 0.5).placed(0.0, [3.5, 3.0]));
        let row: Vec<f64> = covered[3 * 16 + 1..3 * 16 + 7].to_vec();
        assert_eq!(row, [0.0, 0.25, 1.0, 1.0, 0.25, 0.0]);
        assert_eq!(covered.iter().sum::<f64>(), 2.5);
        // A corner that points upwards: the square around the origin turned by 45 degrees.
        let covered = image(&Outline::rectangle(1.0, 1.0).placed(PI / 4.0, [8.0, 8.0]));
        let tip = 2f64.sqrt() - 0.5;
        for [x, y] in [[9, 8], [7, 8], [8, 9], [8, 7]] {
            // The tip of a right angle beyond the edge, minus the two corners beyond the taxel's sides.
            let want = tip * tip - (tip - 0.5).powi(2);
            assert!((covered[y * 16 + x] - want).abs() < 1e-12, "{}", covered[y * 16 + x]);
        }
    }

    #[test]
    fn whatever_the_place_the_parts_add_up() {
        for step in 0..50 {
            let step = f64::from(step);
            let place =
                |outline: Outline| outline.placed(0.37 * step, [7.0 + 0.013 * step, 8.0 - 0.017 * step]);
            let sum = |outline: Outline| image(&place(outline)).iter().sum::<f64>();
            assert!((sum(Outline::rectangle(3.0, 1.5)) - 18.0).abs() < 1e-12);
            assert!((sum(Outline::disc(3.0)) / (9.0 * PI) - 1.0).abs() < 7e-6);
            assert!((sum(Outline::capsule(2.0, 1.5)) / (12.0 + 2.25 * PI) - 1.0).abs() < 7e-6);
        }
    }

    #[test]
    fn corners_stay_within_what_is_said() {
        assert!(1.0 - (PI / CORNERS as f64).cos() < 5e-6);
    }
}
