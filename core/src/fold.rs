//! Posture: how the robot's joints stand, as the host tells it. Later stages compensate the garment's own folding by it.
//!
//! | | |
//! |---|---|
//! | input | [`Posture`] messages |
//! | output | the last posture and its age |
//! | latency | none |
//! | RAM | [`FoldState`]: 64 bytes |

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

/// How the joints stand. Joints that are not named keep their last angle.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Posture {
    /// The joints that are told.
    pub joints: Vec<JointAngle, JOINTS>,
}

/// What is known of the posture.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct FoldState {
    angles: [Option<i16>; JOINTS],
    told: Option<Micros>,
}

impl FoldState {
    /// Takes a message that arrived at `now`, for a scene with `joints`. Nothing of a refused message is taken.
    pub fn accept(&mut self, posture: &Posture, joints: &[Name], now: Micros) -> Result<(), Invalid> {
        let known = joints.len().min(JOINTS);
        for told in &posture.joints {
            if usize::from(told.joint) >= known {
                return Err(Invalid { parameter: "posture.joint", must: "must be a joint of the scene" });
            }
            if !(-18_000..=18_000).contains(&told.centidegrees) {
                return Err(Invalid { parameter: "posture.centidegrees", must: "must be -18000 to 18000" });
            }
        }
        for told in &posture.joints {
            if let Some(angle) = self.angles.get_mut(usize::from(told.joint)) {
                *angle = Some(told.centidegrees);
            }
        }
        self.told = Some(now);
        Ok(())
    }

    /// Angle of a joint in hundredths of a degree; none until it is told.
    pub fn angle(&self, joint: usize) -> Option<i16> {
        self.angles.get(joint).copied().flatten()
    }

    /// Time of the last message.
    pub fn told(&self) -> Option<Micros> {
        self.told
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
        let mut state = FoldState::default();
        let bad = Posture { joints: [angle(0, 900), angle(2, 0)].into_iter().collect() };
        assert_eq!(state.accept(&bad, &joints, Micros(5)).unwrap_err().parameter, "posture.joint");
        assert_eq!((state.angle(0), state.told()), (None, None));
        let far = Posture { joints: [angle(0, 18_001)].into_iter().collect() };
        assert_eq!(state.accept(&far, &joints, Micros(5)).unwrap_err().parameter, "posture.centidegrees");
        let good = Posture { joints: [angle(1, -18_000)].into_iter().collect() };
        state.accept(&good, &joints, Micros(7)).unwrap();
        assert_eq!((state.angle(0), state.angle(1), state.told()), (None, Some(-18_000), Some(Micros(7))));
        assert_eq!(state.angle(99), None);
    }
}
