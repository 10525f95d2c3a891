//! When the board last perceived a frame, and last heard a host.

use crate::format::Micros;

/// Times of the last frame and the last message.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Senses {
    /// Time of the last perceived frame; none since the start, a change of garment, or an interruption.
    pub seen: Option<Micros>,
    /// Time of the last message from a host, or of the start.
    pub heard: Micros,
    /// Number of perceived frames.
    pub frames: u32,
}

impl Senses {
    /// Forgets the last frame: nothing is perceived for now.
    pub fn blind(&mut self) {
        self.seen = None;
    }

    /// True if no frame was perceived since [`Senses::blind`].
    pub fn are_blind(&self) -> bool {
        self.seen.is_none()
    }

    /// Records a message from a host.
    pub fn hear(&mut self, now: Micros) {
        self.heard = now;
    }
}
