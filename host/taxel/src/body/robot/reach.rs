//! Distance by which a point of a link is off if the positions of the joints are.

use super::model::{JointKind, Robot, RobotJoint};

impl Robot {
    /// Joints between a link and a frame: those above the link, from it upwards, and those above the frame, from
    /// it upwards, up to the link that both hang on.
    fn between(&self, link: usize, frame: usize) -> (Vec<&RobotJoint>, Vec<&RobotJoint>) {
        let (mut at, mut other) = (link, frame);
        let (mut above_link, mut above_frame) = (Vec::new(), Vec::new());
        // Each link comes after its parent: the later of two is not above the other.
        while at != other {
            let (later, joints) = match at > other {
                true => (&mut at, &mut above_link),
                false => (&mut other, &mut above_frame),
            };
            let (Some(joint), Some(parent)) = (self.joints.get(*later - 1), self.parent(*later)) else {
                break;
            };
            joints.push(joint);
            *later = parent;
        }
        (above_link, above_frame)
    }

    /// Numbers, among [`Robot::free`], of the joints that move a link in a frame. None of them for links that the
    /// robot does not have.
    pub fn moving(&self, link: usize, frame: usize) -> Vec<usize> {
        let (above_link, above_frame) = self.between(link, frame);
        let drives = above_link.into_iter().chain(above_frame).filter_map(|joint| joint.drive);
        let mut free: Vec<usize> = drives.map(|drive| drive.free).collect();
        free.sort_unstable();
        free.dedup();
        free
    }

    /// Greatest distance, in metres, between where a point of a link is in a frame and where it seems to be, if
    /// the posture is known within `errors` (rad or m, for each position). `farthest` is the point's distance
    /// from the link's origin, m.
    ///
    /// One joint after the other is set right. A joint that is off by an angle moves the point by no more than
    /// the angle times its distance from the axis, and by no more than twice this distance; a joint that is off
    /// by a length by that length. The distance from the axis is no more than the sum of the links' lengths on
    /// the way, in any posture.
    pub fn displacement(
        &self,
        (link, frame): (usize, usize),
        farthest: f64,
        posture: &[f64],
        errors: &[f64],
    ) -> f64 {
        let off = |joint: &RobotJoint| joint.drive.map_or(0.0, |drive| drive.error(errors));
        let length = |joint: &RobotJoint| match (joint.kind, joint.drive) {
            (JointKind::Prismatic, Some(drive)) => {
                joint.origin.at.length() + drive.position(posture).abs() + off(joint)
            }
            _ => joint.origin.at.length(),
        };
        let moved = |joint: &RobotJoint, reach: f64| match joint.kind {
            JointKind::Prismatic => off(joint),
            // The reach is infinite where nothing is known of how far a joint has slid.
            _ if off(joint) == 0.0 => 0.0,
            _ => off(joint).min(2.0) * reach,
        };
        let (above_link, above_frame) = self.between(link, frame);
        let (mut reach, mut distance) = (farthest, 0.0);
        for joint in above_link {
            distance += moved(joint, reach);
            reach += length(joint);
        }
        // From the common link down to the frame, whose axes are as far as the link below them.
        for joint in above_frame.into_iter().rev() {
            reach += length(joint);
            distance += moved(joint, reach);
        }
        distance
    }
}
