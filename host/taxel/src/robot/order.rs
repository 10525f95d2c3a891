//! Orders to the boards of a robot while they are followed.

use crate::client::Client;
use crate::error::Result;
use crate::session::setting;
use crate::source::SceneFile;
use taxel_core::wire::Request;

/// Order to a board while it is followed. Its answer is an event of the board, like any other.
#[derive(Debug, Clone)]
pub enum BoardOrder {
    /// To take the mean of so many frames as the baseline, 1 to 4096.
    Tare(u16),
    /// To use a scene.
    Scene(Box<SceneFile>),
    /// To examine its lines and inputs.
    SelfTest,
}

impl BoardOrder {
    /// Queues it as a request.
    pub(super) fn ask(&self, client: &mut Client) -> Result<()> {
        match self {
            BoardOrder::Tare(frames) => Ok(client.request(&Request::Tare { frames: *frames })?),
            BoardOrder::Scene(scene) => setting::set_scene(client, scene),
            BoardOrder::SelfTest => Ok(client.request(&Request::SelfTest)?),
        }
    }
}
