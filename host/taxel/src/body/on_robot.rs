//! A garment's surface on a robot: places, forces and moments in the frame of any link.

use super::pose::Pose;
use super::posture::Estimate;
use super::robot::{Poses, Robot};
use super::surface::Surface;
use crate::error::RobotError;
use std::sync::Arc;

/// A surface whose links are those of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotSurface {
    surface: Surface,
    robot: Arc<Robot>,
    /// Number in the robot of each of [`Surface::links`].
    links: Vec<usize>,
    /// Distance of the farthest taxel from the origin of each of them, m.
    farthest: Vec<f64>,
}

impl RobotSurface {
    /// Puts a surface on a robot. The error names a link that the robot does not have.
    pub fn new(surface: Surface, robot: Arc<Robot>) -> Result<RobotSurface, RobotError> {
        let links: Vec<usize> =
            surface.links().iter().map(|name| robot.link(name)).collect::<Result<_, RobotError>>()?;
        let mut farthest = vec![0.0; links.len()];
        for place in surface.places().iter().flatten() {
            farthest[place.link] = place.at.length().max(farthest[place.link]);
        }
        Ok(RobotSurface { surface, robot, links, farthest })
    }

    /// The surface, in the frames of its links.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Numbers, among [`Robot::free`], of the joints that move the surface in a frame, by the number of the
    /// frame's link: 0 is the base.
    pub fn moving(&self, frame: usize) -> Vec<usize> {
        let mut all: Vec<usize> =
            self.links.iter().flat_map(|link| self.robot.moving(*link, frame)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Poses of [`Surface::links`] in a frame. Contacts and wrenches of a link are seen from there by
    /// [`TaxelPlace::seen_from`](super::TaxelPlace::seen_from) and
    /// [`Wrench::seen_from`](super::Wrench::seen_from). None without such a frame.
    pub fn poses(&self, poses: &Poses, frame: usize) -> Option<Vec<Pose>> {
        self.links.iter().map(|link| poses.of(*link, frame)).collect()
    }

    /// The surface in the frame of one link: places and normals, and whatever is computed from them. None
    /// without such a frame.
    pub fn seen_from(&self, poses: &Poses, frame: usize) -> Option<Surface> {
        Some(self.surface.moved(&self.poses(poses, frame)?))
    }

    /// The most, in metres, by which any taxel is elsewhere in a frame than an estimated posture says.
    pub fn displacement(&self, estimate: &Estimate, frame: usize) -> f64 {
        let of = |(link, farthest): (&usize, &f64)| {
            self.robot.displacement((*link, frame), *farthest, &estimate.posture, &estimate.errors)
        };
        self.links.iter().zip(&self.farthest).map(of).fold(0.0, f64::max)
    }
}
