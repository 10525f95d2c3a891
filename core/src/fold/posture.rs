//! Posture: angles of the robot's joints, as the host has last sent them.

use crate::format::{Invalid, Micros, Name};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Most joints that a scene follows.
pub const JOINTS: usize = 16;

/// Angle of one joint.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointAngle {
    /// Index into the scene's list of joints.
    pub joint: u8,
    /// Hundredths of a degree, -18000 ..= 18000.
    pub centidegrees: i16,
}

/// Angles of joints. Joints that are left out keep their last angle.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Posture {
    /// Joints and their angles.
    pub joints: Vec<JointAngle, JOINTS>,
}

/// The posture as last sent.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct PostureState {
    angles: [Option<i16>; JOINTS],
    updated: Option<Micros>,
    /// Time of the last message in which a joint had moved.
    moved: Option<Micros>,
}

/// Least change of an angle between two messages that counts as a move, hundredths of a degree.
const MOVES: u16 = 20;
/// Time for which a joint counts as moving after such a message, us.
const MOVES_FOR_US: u64 = 300_000;
/// Age from which on a posture counts for nothing, us: an arm may have moved by half a turn.
pub const STALE_US: u64 = 500_000;

impl PostureState {
    /// None yet.
    pub const fn new() -> PostureState {
        PostureState { angles: [None; JOINTS], updated: None, moved: None }
    }

    /// Takes a message that arrived at `now`, for a scene with `joints`. A refused message changes nothing.
    pub fn accept(&mut self, posture: &Posture, joints: &[Name], now: Micros) -> Result<(), Invalid> {
        let known = joints.len().min(JOINTS);
        for given in &posture.joints {
            if usize::from(given.joint) >= known {
                return Err(Invalid { parameter: "posture.joint", must: "must be a joint of the scene" });
            }
            if !(-18_000..=18_000).contains(&given.centidegrees) {
                return Err(Invalid { parameter: "posture.centidegrees", must: "must be -18000 to 18000" });
            }
        }
        for given in &posture.joints {
            if let Some(angle) = self.angles.get_mut(usize::from(given.joint)) {
                if angle.is_some_and(|was| was.abs_diff(given.centidegrees) >= MOVES) {
                    self.moved = Some(now);
                }
                *angle = Some(given.centidegrees);
            }
        }
        self.updated = Some(now);
        Ok(())
    }

    /// Angle of a joint in hundredths of a degree; none until it is reported.
    pub fn angle(&self, joint: usize) -> Option<i16> {
        self.angles.get(joint).copied().flatten()
    }

    /// True if a joint moves at `now`: the garment may fold against itself, which is no touch.
    pub fn moves(&self, now: Micros) -> bool {
        self.moved.is_some_and(|moved| now.since(moved) < MOVES_FOR_US)
    }

    /// True if the last message came less than [`STALE_US`] before `now`.
    pub fn is_fresh(&self, now: Micros) -> bool {
        self.updated.is_some_and(|updated| now.since(updated) < STALE_US)
    }

    /// Time of the last message.
    pub fn updated(&self) -> Option<Micros> {
        self.updated
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::name;

    #[test]
    fn a_posture_is_taken_whole_or_not_at_all() {
        let joints = [name("elbow"), name("shoulder")];
        let angle = |joint, centidegrees| JointAngle { joint, centidegrees };
        let mut state = PostureState::default();
        let bad = Posture { joints: [angle(0, 900), angle(2, 0)].into_iter().collect() };
        assert_eq!(state.accept(&bad, &joints, Micros(5)).unwrap_err().parameter, "posture.joint");
        assert_eq!((state.angle(0), state.updated()), (None, None));
        let far = Posture { joints: [angle(0, 18_001)].into_iter().collect() };
        assert_eq!(state.accept(&far, &joints, Micros(5)).unwrap_err().parameter, "posture.centidegrees");
        let good = Posture { joints: [angle(1, -18_000)].into_iter().collect() };
        state.accept(&good, &joints, Micros(7)).unwrap();
        assert_eq!((state.angle(0), state.angle(1), state.updated()), (None, Some(-18_000), Some(Micros(7))));
        assert_eq!(state.angle(99), None);
    }

    #[test]
    fn a_joint_moves_while_its_angle_changes_and_a_little_longer() {
        let joints = [name("elbow")];
        let mut state = PostureState::default();
        let mut moved_by = |centidegrees, us| {
            let posture = Posture { joints: [JointAngle { joint: 0, centidegrees }].into_iter().collect() };
            state.accept(&posture, &joints, Micros(us)).unwrap();
            [us, us + 299_999, us + 300_000].map(|us| state.moves(Micros(us)))
        };
        assert_eq!(moved_by(-18_000, 0), [false; 3], "nobody knows from where");
        assert_eq!(moved_by(18_000, 1_000_000), [true, true, false]);
        assert_eq!(moved_by(18_000 - 19, 2_000_000), [false; 3], "it trembles");
        assert_eq!(moved_by(18_000 - 19 - 20, 3_000_000), [true, true, false]);
    }
}
