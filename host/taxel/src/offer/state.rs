//! State of an offered board, as JSON for other programs.

use crate::client::BoardDescription;
use crate::network::BoardPlace;
use serde::Serialize;

/// State of an offered board.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OfferState {
    /// Name of the robot.
    pub robot: String,
    /// Name of the board.
    pub board: String,
    /// Publisher that offers it: 16 hexadecimal digits, as in the keys of requests.
    pub publisher: String,
    /// True while the board is there.
    pub live: bool,
    /// Name of the firmware.
    pub firmware: String,
    /// True of a simulated board.
    pub simulated: bool,
    /// Name of its garment.
    pub garment: String,
    /// Number of taxels of the garment.
    pub taxels: usize,
    /// Name of the scene in force.
    pub scene: String,
    /// Calibration in force; empty if pressure is in counts.
    pub calibration: String,
}

impl OfferState {
    /// Makes the state of a board that is not known yet.
    pub fn new(place: &BoardPlace, publisher: u64) -> OfferState {
        let empty = String::new;
        OfferState {
            robot: place.robot().into(),
            board: place.board().into(),
            publisher: format!("{publisher:016x}"),
            live: false,
            firmware: empty(),
            simulated: false,
            garment: empty(),
            taxels: 0,
            scene: empty(),
            calibration: empty(),
        }
    }

    /// The board is there, and is this.
    pub fn meet(&mut self, description: &BoardDescription) {
        self.live = true;
        self.firmware.clone_from(&description.firmware);
        self.simulated = description.is_simulated();
        self.garment = description.garment.name.to_string();
        self.taxels = description.layout.taxels();
        self.scene = description.scene.name.to_string();
        self.calibration.clone_from(&description.calibration);
    }
}
