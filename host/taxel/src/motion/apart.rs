//! Links that commands keep apart.

use super::config::ApartConfig;
use crate::body::DVec3;
use crate::body::robot::{Poses, Robot};
use std::fmt::Display;

/// Time within which two links may use up the distance that is left, s.
const WITHIN_S: f64 = 0.2;

/// Two links, each with the far end of its line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ApartLinks {
    links: [(usize, usize); 2],
    metres: f64,
}

/// Finds the links of a pair.
pub(super) fn links(robot: &Robot, pair: &ApartConfig) -> Result<ApartLinks, impl Display> {
    let line = |name: &str| {
        let link = robot.link(name)?;
        let rest = robot.poses(&robot.rest());
        let length = |end: &usize| rest.of(*end, link).map_or(0.0, |pose| pose.at.length());
        let children = robot.joints().iter().enumerate().filter(|(_, joint)| joint.parent == link);
        let end = children.map(|(joint, _)| joint + 1).max_by(|a, b| length(a).total_cmp(&length(b)));
        Ok::<_, crate::error::RobotError>((link, end.unwrap_or(link)))
    };
    let [first, second] = &pair.links;
    Ok::<_, crate::error::RobotError>(ApartLinks {
        links: [line(first)?, line(second)?],
        metres: pair.metres,
    })
}

impl ApartLinks {
    /// The share of these velocities, 0 to 1, with which the links do not come too near each other.
    pub fn share(&self, robot: &Robot, poses: &Poses, velocities: &[f64]) -> f64 {
        let origin = |link: usize| poses.of(link, 0).map(|pose| pose.at);
        let line = |(link, end): (usize, usize)| Some((origin(link)?, origin(end)?));
        let [first, second] = self.links;
        let Some((a, b)) = line(first).zip(line(second)) else { return 1.0 };
        let (on_a, on_b) = nearest(a, b);
        let between = on_a - on_b;
        let velocity = |link: usize, at: DVec3| -> DVec3 {
            let columns = robot.jacobian(poses, link, at);
            columns.iter().zip(velocities).map(|(column, velocity)| *column * *velocity).sum()
        };
        let away = between.normalize_or_zero();
        let closing = -away.dot(velocity(first.0, on_a) - velocity(second.0, on_b));
        let allowed = (between.length() - self.metres).max(0.0) / WITHIN_S;
        if closing > allowed { allowed / closing } else { 1.0 }
    }
}

/// The points of two lines that are nearest to each other.
fn nearest((a, a_end): (DVec3, DVec3), (b, b_end): (DVec3, DVec3)) -> (DVec3, DVec3) {
    let (along_a, along_b, apart) = (a_end - a, b_end - b, a - b);
    let (aa, bb, ab) = (along_a.length_squared(), along_b.length_squared(), along_a.dot(along_b));
    let (da, db) = (along_a.dot(apart), along_b.dot(apart));
    let share = |over: f64, under: f64| if under > 0.0 { (over / under).clamp(0.0, 1.0) } else { 0.0 };
    // Where they are parallel any point does.
    let s = share(ab * db - bb * da, aa * bb - ab * ab);
    let t = share(ab * s + db, bb);
    let s = share(ab * t - da, aa);
    (a + s * along_a, b + t * along_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_points_of_two_lines() {
        let point = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let along_x = (point(0.0, 0.0, 0.0), point(1.0, 0.0, 0.0));
        for (other, found) in [
            // Crossed, parallel, beyond the end, a point.
            ((point(0.5, -1.0, 0.2), point(0.5, 1.0, 0.2)), 0.2),
            ((point(0.2, 0.3, 0.0), point(0.8, 0.3, 0.0)), 0.3),
            ((point(2.0, 0.0, 0.0), point(3.0, 1.0, 0.0)), 1.0),
            ((point(0.4, 0.0, 0.7), point(0.4, 0.0, 0.7)), 0.7),
        ] {
            let (a, b) = nearest(along_x, other);
            assert!((a.distance(b) - found).abs() < 1e-12, "{other:?}: {a} {b}");
            let (b, a) = nearest(other, along_x);
            assert!((a.distance(b) - found).abs() < 1e-12, "{other:?}: {a} {b}");
        }
    }
}
