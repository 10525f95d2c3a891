//! Place of a taxel, or of a point between taxels.

use super::pose::Pose;
use glam::DVec3;

/// Place of a taxel on the robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaxelPlace {
    /// Index into [`Surface::links`](super::Surface::links).
    pub link: usize,
    /// Centre, m, in the link's frame unless it is [seen from](TaxelPlace::seen_from) another.
    pub at: DVec3,
    /// Direction away from the robot there, of length 1.
    pub normal: DVec3,
    /// Index into [`Surface::regions`](super::Surface::regions); none where no region of the body is.
    pub region: Option<usize>,
}

impl TaxelPlace {
    /// The place in another frame, by the pose of its own frame in it.
    pub fn seen_from(&self, pose: &Pose) -> TaxelPlace {
        TaxelPlace { at: pose.point(self.at), normal: pose.direction(self.normal), ..*self }
    }
}
