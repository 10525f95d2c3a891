//! The links that carry a garment, as they move: for a board that carries them on between two messages.

use crate::body::posture::{Estimate, JointHistory};
use crate::body::{DVec3, Pose, RobotSurface};
use glam::DQuat;
use taxel_core::format::Micros;
use taxel_core::surface::{CARRIED_US, LinkMotion};

/// Step from which velocities are taken, us.
const STEP_US: u64 = 10_000;
/// Times at which the bound is compared with what may happen, from the first to the last that a board uses.
const SAMPLES: u64 = 8;
/// Share by which the bound is wider than at those times, because it lies between them.
const SPARE: f64 = 1.05;

/// Pose and motion of each of the surface's links in the base, at the time of an estimate: `now`.
pub(super) fn moving(
    surface: &RobotSurface,
    history: &JointHistory,
    estimate: &Estimate,
    now: Micros,
) -> Option<Vec<(Pose, LinkMotion)>> {
    let poses = |estimate: &Estimate| surface.poses(&surface.robot().poses(&estimate.posture), 0);
    let off = |estimate: &Estimate| surface.sent_displacement(&estimate.posture, estimate, 0);
    let later = |us: u64| history.live(Micros(now.0.saturating_add(us))).ok();
    let (here, next, second) = (poses(estimate)?, later(STEP_US)?, later(2 * STEP_US)?);
    let there = poses(&next)?;
    let step = STEP_US as f64 * 1e-6;
    let error = off(estimate);
    // Errors of joints grow as a t + b t^2: from three of them.
    let [first, double] = [off(&next) - error, off(&second) - error];
    let drift = ((4.0 * first - double) / (2.0 * step)).max(0.0);
    let samples = (1..=SAMPLES).map(|number| {
        let us = u64::from(CARRIED_US) * number / SAMPLES;
        let estimate = later(us)?;
        Some((us as f64 * 1e-6, off(&estimate), poses(&estimate)?))
    });
    let samples: Vec<(f64, f64, Vec<Pose>)> = samples.collect::<Option<_>>()?;
    let link = |(link, (pose, there)): (usize, (&Pose, &Pose))| {
        let velocity = (there.at - pose.at) / step;
        let spin = (there.turn * pose.turn.conjugate()).to_scaled_axis() / step;
        let reach = farthest(surface, link);
        // The bound holds from one sample to the next: it is as wide as what may happen at the next.
        let mut acceleration = (2.0 * (double - 2.0 * first) / (2.0 * step * step)).max(0.0);
        for (seconds, off, poses) in &samples {
            let carried = Pose {
                at: pose.at + velocity * *seconds,
                turn: DQuat::from_scaled_axis(spin * *seconds) * pose.turn,
            };
            let apart = poses.get(link).map_or(f64::INFINITY, |live| apart(&carried, live, reach));
            let missing = (off + apart) * SPARE - error - drift * seconds;
            acceleration = acceleration.max(2.0 * missing / (seconds * seconds));
        }
        let rounded = |vector: DVec3, one: f64| (vector * one).to_array().map(|part| part.round() as i32);
        let up = |metres: f64| (metres * 1e6).ceil() as u32;
        let motion = LinkMotion {
            velocity: rounded(velocity, 1e6),
            spin: rounded(spin, f64::from(1 << 20)),
            error: up(error),
            drift: up(drift),
            acceleration: up(acceleration),
        };
        (*pose, motion)
    };
    Some(here.iter().zip(&there).enumerate().map(link).collect())
}

/// Distance of the farthest taxel of a link from its origin, m.
fn farthest(surface: &RobotSurface, link: usize) -> f64 {
    let places = surface.surface().places().iter().flatten().filter(|place| place.link == link);
    places.map(|place| place.at.length()).fold(0.0, f64::max)
}

/// The most by which a point within `reach` of the origin is elsewhere in two poses, m.
fn apart(one: &Pose, other: &Pose, reach: f64) -> f64 {
    one.at.distance(other.at) + one.turn.angle_between(other.turn) * reach
}
