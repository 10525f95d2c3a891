//! Scale of forces of a recorded board.

use super::board_recording::BoardRecording;
use super::overview::Overview;
use crate::error::{RecordingError, Result};
use crate::files::calibrate::{Calibration, ForceScale};

/// Attachment with the calibration.
pub const CALIBRATION: &str = "calibration.toml";

/// Reads an attached calibration; errors call it by this name.
pub fn calibration(bytes: &[u8], name: &str) -> Result<Calibration> {
    let text = str::from_utf8(bytes);
    let text = text.map_err(|_| error!(RecordingError::Record, "{name} is not text"))?;
    Calibration::parse(text, name)
}

/// Scale of forces of a board: its attached calibration, and the counts per newton of its source.
pub fn force_scale(overview: &Overview, recording: &BoardRecording) -> Result<ForceScale> {
    let name = format!("{CALIBRATION} of {recording}");
    let attached = overview.attached(&recording.attachment(CALIBRATION))?;
    let calibration = attached.map(|bytes| calibration(&bytes, &name)).transpose()?;
    let words = overview.words(&recording.attachment("taxel"));
    let counts = words.and_then(|words| words.get("counts_per_newton")?.parse().ok());
    Ok(ForceScale::new(calibration, counts))
}
