//! Touches that oppose each other: something is clamped by the robot, or the robot between two things. Whatever it did
//! along one normal would press on the other.

use super::config::ClampConfig;
use super::input::MotionTouch;
use super::spot::TouchedSpot;
use crate::mind::Mover;

/// Distance of two surfaces of the robot between which nothing fits, m: it touches itself. A finger is thicker.
const ITSELF_M: f64 = 0.01;

/// True if two of these touches oppose each other.
pub(super) fn is_clamped(touches: &[(&MotionTouch, TouchedSpot)], config: &ClampConfig) -> bool {
    touches.iter().enumerate().any(|(number, (touch, spot))| {
        touch.newtons >= config.newtons
            && touches[..number].iter().any(|(other, against)| {
                other.newtons >= config.newtons
                    && spot.normal.dot(against.normal) <= config.cosine
                    && !is_itself((touch, spot), (other, against))
            })
    })
}

/// True if two touches are the robot's own surface on itself.
fn is_itself(
    (touch, spot): (&MotionTouch, &TouchedSpot),
    (other, against): (&MotionTouch, &TouchedSpot),
) -> bool {
    let is_own = touch.mover == Mover::Own && other.mover == Mover::Own;
    is_own && touch.link != other.link && spot.at.distance(against.at) < ITSELF_M
}
