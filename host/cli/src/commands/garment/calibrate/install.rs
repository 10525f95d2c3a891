//! Sends a calibration to a board.

use crate::watch::raw::RawBoard;
use anyhow::Result;
use taxel::files::calibrate::Calibration;

/// Sets gains and certificate. Error if the board refuses.
pub fn install(board: &mut RawBoard, calibration: &Calibration) -> Result<()> {
    calibration.requests().try_for_each(|request| board.ask(&request))
}
