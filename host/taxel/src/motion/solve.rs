//! Damped least squares: the joint velocities that fulfil goals best, within bounds.

use crate::body::DVec3;

/// Damping, m/rad: directions in which a point moves by less than that for a radian cost much velocity, and are left
/// out little by little. From 0.05 m/rad on a velocity is turned by at most 4.3 degrees, and cut by 14 %.
const DAMPING: f64 = 0.02;
/// Weight of a goal of the next level: goals of the first level are disturbed by about a hundredth.
pub(super) const NEXT_LEVEL: f64 = 0.01;

/// A velocity that a point of the robot should have.
#[derive(Debug, Clone)]
pub(super) struct Goal {
    /// Velocity of the point for a velocity of 1 of each joint.
    pub columns: Vec<DVec3>,
    /// Velocity in the base, m/s.
    pub velocity: DVec3,
    /// Weight, 0 to 1.
    pub weight: f64,
}

/// Bounds of a joint's velocity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    /// The least, at most 0, and the greatest, at least 0, at its position.
    pub range: (f64, f64),
    /// The greatest at any position.
    pub most: f64,
}

/// Velocities within the bounds. A joint that may not turn as far as it should is held, and the others do what they
/// can without it; where all are too fast they are slowed down alike, which keeps the direction.
pub(super) fn solve(goals: &[Goal], bounds: &[Bound]) -> Vec<f64> {
    let mut held: Vec<Option<f64>> = bounds.iter().map(|bound| (bound.most <= 0.0).then_some(0.0)).collect();
    loop {
        let mut velocities = least(goals, &held);
        let shares = velocities.iter().zip(bounds).map(|(velocity, bound)| {
            if velocity.abs() > bound.most { bound.most / velocity.abs() } else { 1.0 }
        });
        let share = shares.fold(1.0, f64::min);
        velocities.iter_mut().for_each(|velocity| *velocity *= share);
        let beyond = |joint: &usize| {
            let (least, most) = bounds[*joint].range;
            (velocities[*joint] - velocities[*joint].clamp(least, most)).abs()
        };
        let open = (0..bounds.len()).filter(|joint| held[*joint].is_none());
        let worst = open.max_by(|a, b| beyond(a).total_cmp(&beyond(b))).filter(|joint| beyond(joint) > 1e-12);
        let Some(worst) = worst else { return velocities };
        let (least, most) = bounds[worst].range;
        held[worst] = Some(velocities[worst].clamp(least, most));
    }
}

/// The velocities that minimise the weighted errors of the goals and the damping; held joints have theirs.
fn least(goals: &[Goal], held: &[Option<f64>]) -> Vec<f64> {
    let open: Vec<usize> = (0..held.len()).filter(|joint| held[*joint].is_none()).collect();
    let size = open.len();
    let (mut matrix, mut right) = (vec![0.0; size * size], vec![0.0; size]);
    for goal in goals {
        let by_held = goal.columns.iter().zip(held).filter_map(|(column, held)| Some(*column * (*held)?));
        let rest = goal.velocity - by_held.sum::<DVec3>();
        for (row, joint) in open.iter().enumerate() {
            let column = goal.weight * goal.columns[*joint];
            right[row] += column.dot(rest);
            for (other, with) in open.iter().enumerate().take(row + 1) {
                matrix[row * size + other] += column.dot(goal.columns[*with]);
            }
        }
    }
    for row in 0..size {
        matrix[row * size + row] += DAMPING * DAMPING;
    }
    cholesky(&mut matrix, &mut right);
    let mut velocities: Vec<f64> = held.iter().map(|held| held.unwrap_or(0.0)).collect();
    open.iter().zip(right).for_each(|(joint, velocity)| velocities[*joint] = velocity);
    velocities
}

/// Solves a positive definite system in place; of the matrix the lower half is read.
fn cholesky(matrix: &mut [f64], right: &mut [f64]) {
    let size = right.len();
    for row in 0..size {
        for column in 0..=row {
            let done = (0..column).map(|k| matrix[row * size + k] * matrix[column * size + k]);
            let rest = matrix[row * size + column] - done.sum::<f64>();
            matrix[row * size + column] =
                if row == column { rest.sqrt() } else { rest / matrix[column * size + column] };
        }
        let done = (0..row).map(|k| matrix[row * size + k] * right[k]);
        right[row] = (right[row] - done.sum::<f64>()) / matrix[row * size + row];
    }
    for row in (0..size).rev() {
        let done = (row + 1..size).map(|k| matrix[k * size + row] * right[k]);
        right[row] = (right[row] - done.sum::<f64>()) / matrix[row * size + row];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE: Bound = Bound { range: (-9.0, 9.0), most: 9.0 };

    fn reached(goal: &Goal, velocities: &[f64]) -> DVec3 {
        goal.columns.iter().zip(velocities).map(|(column, velocity)| *column * *velocity).sum()
    }

    fn goal(columns: &[[f64; 3]], velocity: [f64; 3]) -> Goal {
        Goal {
            columns: columns.iter().map(|it| DVec3::from(*it)).collect(),
            velocity: velocity.into(),
            weight: 1.0,
        }
    }

    #[test]
    fn a_goal_is_turned_by_less_than_five_degrees_from_the_least_singular_value_of_0_05_on() {
        for slant in 0..=90 {
            let (y, x) = f64::from(slant).to_radians().sin_cos();
            let goal = goal(&[[0.5, 0.0, 0.0], [0.0, 0.05, 0.0], [0.0, 0.0, 0.3]], [0.1 * x, 0.1 * y, 0.0]);
            let angle =
                reached(&goal, &solve(std::slice::from_ref(&goal), &[WIDE; 3])).angle_between(goal.velocity);
            assert!(angle.to_degrees() < 4.5, "{slant}: {}", angle.to_degrees());
        }
    }

    #[test]
    fn a_held_joint_leaves_its_part_to_the_others() {
        let goal = goal(&[[0.4, 0.0, 0.0], [0.4, 0.0, 0.0]], [0.2, 0.0, 0.0]);
        let bounds = [Bound { range: (-9.0, 0.0), ..WIDE }, WIDE];
        let velocities = solve(std::slice::from_ref(&goal), &bounds);
        assert_eq!(velocities[0], 0.0);
        assert!((reached(&goal, &velocities).x - 0.2).abs() < 0.001, "{velocities:?}");
    }

    #[test]
    fn too_fast_is_slowed_down_in_the_same_direction() {
        let goal = goal(&[[0.1, 0.0, 0.0], [0.0, 0.4, 0.0]], [1.0, 1.0, 0.0]);
        let bounds = [Bound { range: (-1.0, 1.0), most: 1.0 }; 2];
        let velocities = solve(std::slice::from_ref(&goal), &bounds);
        assert!(velocities.iter().all(|velocity| velocity.abs() <= 1.0 + 1e-12));
        assert!(reached(&goal, &velocities).angle_between(goal.velocity) < 0.03);
    }

    #[test]
    fn without_goals_nothing_moves() {
        assert_eq!(solve(&[], &[WIDE; 3]), [0.0; 3]);
    }
}
