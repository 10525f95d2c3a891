//! Limits of the joints: position, velocity, acceleration.

use std::ops::RangeInclusive;

/// Time constant of the last bit before a limit, s: several cycles.
const CREEP_S: f64 = 0.02;

/// Limits of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointLimit {
    /// Greatest velocity, rad/s or m/s; 0: the joint is never moved.
    pub velocity: f64,
    /// Greatest acceleration, rad/s^2 or m/s^2.
    pub acceleration: f64,
    /// Positions that are never left, rad or m; those of the joint and of all that mimic it. None: it turns on and on.
    pub positions: Option<RangeInclusive<f64>>,
}

impl JointLimit {
    /// Velocities at a position, least and greatest, from which the joint can still brake before its limits if it has
    /// moved with `velocity` for `late` seconds since it was there. 0 is always among them.
    pub(super) fn velocities(&self, position: f64, velocity: f64, late: f64) -> (f64, f64) {
        let Some(positions) = &self.positions else { return (-self.velocity, self.velocity) };
        let now = position + velocity * late;
        // From sqrt(2 a d) a joint stops within a distance d; half of the acceleration is kept for the time of a cycle.
        // The last bit it creeps.
        let toward = |distance: f64| {
            let distance = distance.max(0.0);
            (self.acceleration * distance).sqrt().min(distance / CREEP_S).min(self.velocity)
        };
        (-toward(now - positions.start()), toward(positions.end() - now))
    }
}

/// The share of a change of velocities, 0 to 1, that all accelerations allow within a time, s: a change that is cut as
/// a whole keeps its direction.
pub(super) fn allowed_change(limits: &[JointLimit], from: &[f64], to: &[f64], seconds: f64) -> f64 {
    let changes = limits.iter().zip(from.iter().zip(to));
    let shares = changes.map(|(limit, (from, to))| {
        let change = (to - from).abs();
        if change > 0.0 { limit.acceleration * seconds / change } else { 1.0 }
    });
    shares.fold(1.0, f64::min).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMIT: JointLimit = JointLimit { velocity: 2.0, acceleration: 8.0, positions: Some(-1.0..=1.0) };

    #[test]
    fn a_joint_brakes_before_its_limits() {
        // The worst: as fast as allowed towards the limit, in cycles of 5 ms, from a posture that is one cycle old.
        let (mut at, mut before, mut velocity) = (0.0, 0.0, 0.0_f64);
        for _ in 0..2000 {
            let (_, most) = LIMIT.velocities(before, velocity, 0.005);
            let next = (velocity + LIMIT.acceleration * 0.005).min(most);
            assert!(velocity - next <= LIMIT.acceleration * 0.005 + 1e-9, "{velocity} {next}");
            velocity = next;
            (before, at) = (at, at + velocity * 0.005);
            assert!(at <= 1.0, "{at}");
        }
        assert!(at > 0.99, "{at}");
    }

    #[test]
    fn beyond_a_limit_only_the_way_back_is_open() {
        assert_eq!(LIMIT.velocities(1.2, 0.0, 0.0), (-2.0, 0.0));
        assert_eq!(LIMIT.velocities(-1.2, 0.0, 0.0), (-0.0, 2.0));
    }

    #[test]
    fn a_change_is_cut_as_a_whole() {
        let limits = [LIMIT, JointLimit { acceleration: 1.0, ..LIMIT }];
        let share = allowed_change(&limits, &[0.0, 0.0], &[0.4, 0.1], 0.01);
        assert!((share - 0.1).abs() < 1e-12, "{share}");
        assert_eq!(allowed_change(&limits, &[0.3, 0.1], &[0.3, 0.1], 0.01), 1.0);
    }
}
