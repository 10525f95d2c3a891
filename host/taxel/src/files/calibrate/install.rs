//! Sends a calibration to a board.

use super::file::Calibration;
use taxel_core::wire::Request;

/// Gains per request.
const CHUNK: usize = 64;

impl Calibration {
    /// Requests for the gains, then for the certificate.
    pub fn requests(&self) -> impl Iterator<Item = Request<'static>> {
        let gains = |(index, gains): (usize, &[u16])| Request::SetGain {
            first: (index * CHUNK) as u16,
            gains: gains.iter().copied().collect(),
        };
        let certificate = Request::SetCalibration(self.certificate());
        self.gains.chunks(CHUNK).enumerate().map(gains).chain([certificate])
    }
}
