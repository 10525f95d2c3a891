//! Requests to the board.

use super::Client;
use super::wanted::Sets;
use crate::error::{Context, Result, SettingError};
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, Request, WireError, encode, frame_bound};

/// Encodes a scene for `SetScene`. Error if it is too long for a request.
pub fn scene_bytes(scene: &Scene) -> Result<Vec<u8>> {
    let bytes = postcard::to_allocvec(scene).context("the scene cannot be written")?;
    // The request around it: its number and the length.
    let room = LONGEST_REQUEST - 3;
    if bytes.len() > room {
        fail!(
            SettingError::TooLong,
            "the scene takes {} bytes, and a request has room for {room}",
            bytes.len()
        );
    }
    Ok(bytes)
}

/// Name of a request, by its number.
pub fn request_name(number: u8) -> &'static str {
    const NAMES: [&str; 27] = [
        "set-garment",
        "set-scene",
        "tare",
        "start",
        "stop",
        "sync",
        "posture",
        "concept",
        "key-frame",
        "self-test",
        "save",
        "set-gain",
        "budget",
        "feed",
        "set-gestures",
        "set-calibration",
        "set-shapes",
        "add-shapes",
        "set-certainty",
        "reset-settings",
        "set-forms",
        "set-raw",
        "set-surface",
        "set-poses",
        "set-pressing",
        "set-folds",
        "move-poses",
    ];
    NAMES.get(usize::from(number)).copied().unwrap_or("unreadable request")
}

/// Requests.
impl Client {
    /// Requests the whole stream, and a tare over `tare` frames unless 0. A board that restarts later gets
    /// these and all other settings again.
    pub fn start(&mut self, tare: u16) -> Result<(), WireError> {
        self.streaming = true;
        self.request(&Request::Start)?;
        if tare > 0 { self.request(&Request::Tare { frames: tare }) } else { Ok(()) }
    }

    /// Queues a request. Error if it is too long.
    pub fn request(&mut self, request: &Request<'_>) -> Result<(), WireError> {
        let mut frame = [0; frame_bound(LONGEST_REQUEST)];
        let frame = encode(request, &mut frame)?;
        if let Request::SetForms { ages, .. } = request {
            self.ages_asked = *ages;
        }
        if matches!(request, Request::Sync { .. } | Request::KeyFrame) {
            // This request does not depend on queued ones.
            self.requests.extend_from_slice(frame);
            return Ok(());
        }
        self.held.push_back((frame.to_vec(), Sets::of(request, frame)));
        self.release();
        Ok(())
    }

    /// Sends held requests in order, while the board has answers to spare and is not being restored. A garment waits
    /// for the first `Hello`: the one that the board has by itself is what it is recognised by after a restart.
    pub(super) fn release(&mut self) {
        while !self.is_restoring()
            && let Some((frame, sets)) = self.held.pop_front_if(|(_, sets)| {
                let is_early = self.worn.is_none() && sets.as_ref().is_some_and(Sets::is_garment);
                sets.is_none() || self.life.wanted.takes_more() && !is_early
            })
        {
            self.requests.extend(frame);
            let Some(sets) = sets else { continue };
            sets.garment().iter().for_each(|garment| self.identity.learn_garment(garment));
            self.life.wanted.ask(sets);
        }
    }

    /// Queues `SetScene`.
    pub fn use_for(&mut self, scene: &Scene) -> Result<()> {
        Ok(self.request(&Request::SetScene(&scene_bytes(scene)?))?)
    }

    /// Requests the raw codes of every frame, if none are received. Returns whether it did; false before the
    /// first `Hello`.
    pub fn request_codes(&mut self) -> Result<bool, WireError> {
        let asks = self.worn.as_ref().is_some_and(|worn| worn.scene.stream.raw_hz == 0);
        if asks {
            self.request(&Request::SetRaw { hz: u16::MAX })?;
        }
        Ok(asks)
    }

    /// True while a table of the surface is on its way to the board: it knows no links for poses yet.
    pub fn is_storing_table(&self) -> bool {
        let held = self.held.iter().any(|(_, sets)| sets.as_ref().is_some_and(Sets::is_piece));
        held || self.life.wanted.awaits_piece()
    }

    /// Bytes to be sent to the board, including requests held back.
    pub fn queued(&self) -> Vec<u8> {
        let held = self.held.iter().flat_map(|(frame, _)| frame);
        self.requests.iter().chain(held).copied().collect()
    }

    /// Takes the bytes to be sent to the board.
    pub fn take_requests(&mut self) -> Vec<u8> {
        self.release();
        let again = if self.is_met() { self.life.again.due() } else { None };
        self.requests.extend(again.into_iter().flatten());
        let sync = if self.worn.is_some() && self.streaming { self.syncs.next() } else { None };
        if let Some(sync) = sync {
            // A request of a few bytes always fits.
            let _ = self.request(&sync);
        }
        std::mem::take(&mut self.requests)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_request_has_the_last_name() {
        // Numbers are those of the variants on the wire; new ones are only appended.
        let number = |request: &Request<'_>| postcard::to_allocvec(request).unwrap()[0];
        assert_eq!(request_name(number(&Request::SetFolds(&[]))), "set-folds");
        let last = number(&Request::MovePoses(&[]));
        assert_eq!(request_name(last), "move-poses");
        assert_eq!(request_name(last + 1), "unreadable request");
        assert!(postcard::from_bytes::<Request<'_>>(&[last + 1, 0]).is_err(), "a request has no name");
    }
}
