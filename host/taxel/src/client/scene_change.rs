//! A change of the board's scene in what ends no contact and no reaction.

use taxel_core::gesture::GestureConfig;
use taxel_core::scene::Scene;

/// Settings of a scene to change; what is none stays.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct SceneChange {
    /// Recognition of gestures; none in it: off.
    pub gestures: Option<Option<GestureConfig>>,
    /// Number of held contacts that have their form measured in a frame, 0 for all, and whether its age is reported.
    pub forms: Option<(u8, bool)>,
    /// Reports per second of what presses on the robot.
    pub pressing_hz: Option<u16>,
}

impl SceneChange {
    /// So many reports per second of what presses on the robot.
    pub fn pressing(hz: u16) -> SceneChange {
        SceneChange { pressing_hz: Some(hz), ..SceneChange::default() }
    }

    /// Changes a scene.
    pub(super) fn apply(&self, scene: &mut Scene) {
        if let Some(gestures) = self.gestures {
            scene.gestures = gestures;
        }
        if let Some((in_frame, ages)) = self.forms {
            (scene.contact.forms_in_frame, scene.stream.form_ages) = (in_frame, ages);
        }
        if let Some(hz) = self.pressing_hz {
            scene.stream.pressing_hz = hz;
        }
    }
}
