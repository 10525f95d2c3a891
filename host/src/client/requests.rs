//! What the host asks of the board.

use super::Client;
use anyhow::{Context, Result, bail};
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, Request, WireError, encode, frame_bound};

/// A scene as a `SetScene` carries it. An error says that it is too long for a request.
pub fn scene_bytes(scene: &Scene) -> Result<Vec<u8>> {
    let bytes = postcard::to_allocvec(scene).context("the scene cannot be written")?;
    // The request around it: its number and the length.
    let room = LONGEST_REQUEST - 3;
    if bytes.len() > room {
        bail!("the scene takes {} bytes, and a request holds {room} of it", bytes.len());
    }
    Ok(bytes)
}

/// Requests.
impl Client {
    /// Asks for everything, also from a board that starts anew later; and for a tare over `tare` frames, unless 0.
    pub fn start(&mut self, tare: u16) -> Result<(), WireError> {
        self.streaming = true;
        self.request(&Request::Start)?;
        if tare > 0 { self.request(&Request::Tare { frames: tare }) } else { Ok(()) }
    }

    /// Queues a request. An error: it is too long.
    pub fn request(&mut self, request: &Request<'_>) -> Result<(), WireError> {
        let mut frame = [0; frame_bound(LONGEST_REQUEST)];
        self.requests.extend_from_slice(encode(request, &mut frame)?);
        if let Request::SetForms { ages, .. } = request {
            self.ages_asked = *ages;
        }
        Ok(())
    }

    /// Queues `SetScene`.
    pub fn use_for(&mut self, scene: &Scene) -> Result<()> {
        Ok(self.request(&Request::SetScene(&scene_bytes(scene)?))?)
    }

    /// Asks for the raw codes of every frame where none come; whether it did. Nothing is known of the board: nothing is asked.
    pub fn request_codes(&mut self) -> Result<bool> {
        let Some(mut scene) = self.worn.as_ref().map(|worn| worn.scene.clone()) else { return Ok(false) };
        let asks = scene.stream.raw_hz == 0;
        if asks {
            scene.stream.raw_hz = u16::MAX;
            self.use_for(&scene)?;
        }
        Ok(asks)
    }

    /// The bytes that wait to be sent to the board.
    pub fn queued(&self) -> &[u8] {
        &self.requests
    }

    /// The bytes that are to be sent to the board.
    pub fn take_requests(&mut self) -> Vec<u8> {
        let sync = if self.worn.is_some() && self.streaming { self.syncs.next() } else { None };
        if let Some(sync) = sync {
            // A request of a few bytes fits.
            let _ = self.request(&sync);
        }
        std::mem::take(&mut self.requests)
    }
}
