//! Cloth that moves over the skin with the joints.

use super::config::Body;
use super::robot::{Drive, Robot};
use crate::error::SettingError;
use glam::DVec2;

/// A slide of a patch whose joint is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PatchSlide {
    /// Index of the patch.
    pub patch: usize,
    drive: Drive,
    /// To the right and down, m for each rad or m of the joint.
    along: DVec2,
}

impl PatchSlide {
    /// Way of the patch in a posture, m.
    pub fn way(&self, posture: &[f64]) -> DVec2 {
        self.along * self.drive.position(posture)
    }

    /// The most by which the way is off, m.
    pub fn error(&self, errors: &[f64]) -> f64 {
        self.along.length() * self.drive.error(errors)
    }

    /// Number of its joint among [`Robot::free`].
    pub fn free(&self) -> usize {
        self.drive.free
    }
}

/// The slides of a body whose joints are those of a robot. Errors name the slide by index and key:
/// `patches[2].slides[0].joint`.
pub(super) fn slides(body: &Body, robot: &Robot) -> Result<Vec<PatchSlide>, SettingError> {
    let mut all = Vec::new();
    for (patch, slides) in body.patches.iter().map(|patch| &patch.slides).enumerate() {
        for (index, slide) in slides.iter().enumerate() {
            let wrong = |key: &str, what: String| {
                let key = format!("patches[{patch}].slides[{index}].{key}");
                SettingError::Key { text: format!("`{key}` {what}"), key }
            };
            let joint = robot.joint(&slide.joint).map_err(|error| wrong("joint", error.to_string()))?;
            let Some(drive) = robot.joints()[joint].drive else {
                return Err(wrong("joint", "must be a joint that moves".into()));
            };
            for (key, way) in [("right", slide.right), ("down", slide.down)] {
                if !way.is_finite() {
                    return Err(wrong(key, "must be a number".into()));
                }
            }
            let along = DVec2::new(slide.right, slide.down);
            if along != DVec2::ZERO {
                all.push(PatchSlide { patch, drive, along });
            }
        }
    }
    Ok(all)
}
