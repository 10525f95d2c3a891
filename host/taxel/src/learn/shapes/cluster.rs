//! Reduces the examples of a class to a few prototypes.

use taxel_core::shape::{DIMENSIONS, Point};

/// Rounds of Lloyd's algorithm; it converges long before.
const ROUNDS: usize = 20;

/// At most `count` centres of points, by k-means; the points themselves if there are no more of them. The
/// first centre starts at the mean of all, each further one at the point farthest from the centres so far.
pub fn centres(points: &[Point], count: usize) -> Vec<Point> {
    if points.len() <= count {
        return points.to_vec();
    }
    let mut centres = vec![mean(points)];
    while centres.len() < count {
        let far =
            points.iter().max_by_key(|point| nearest(&centres, point).1).expect("there are more points");
        centres.push(*far);
    }
    for _ in 0..ROUNDS {
        let mut members = vec![Vec::new(); centres.len()];
        points.iter().for_each(|point| members[nearest(&centres, point).0].push(*point));
        let moved = centres
            .iter()
            .zip(&members)
            .map(|(centre, members)| if members.is_empty() { *centre } else { mean(members) });
        let moved: Vec<Point> = moved.collect();
        if moved == centres {
            break;
        }
        centres = moved;
    }
    centres
}

/// Index of the nearest centre, and its squared distance.
fn nearest(centres: &[Point], point: &Point) -> (usize, u64) {
    let distance = |centre: &Point| -> u64 {
        centre.iter().zip(point).map(|(a, b)| u64::from(a.abs_diff(*b)).pow(2)).sum()
    };
    let all = centres.iter().map(distance).enumerate();
    all.min_by_key(|(_, distance)| *distance).expect("there is a centre")
}

/// The mean of points; 0 without any.
pub fn mean(points: &[Point]) -> Point {
    let mut mean = [0; DIMENSIONS];
    for (i, at) in mean.iter_mut().enumerate() {
        let sum: f64 = points.iter().map(|point| f64::from(point[i])).sum();
        *at = (sum / points.len() as f64).round() as i16;
    }
    mean
}
