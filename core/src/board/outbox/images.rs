//! Images and raw codes that wait for the link. They are encoded when it has room, from the newest frame.

use super::about::About;
use crate::board::pace::Pace;
use crate::board::tx_frame::TxFrame;
use crate::body::Placed;
use crate::format::{Code, Micros};
use crate::wire::{Frame, Health, ImageReference, Raw, Report, encode_image};
use heapless::Vec;

/// The image to send, and the one sent last.
pub(super) struct ImageQueue<const TAXELS: usize> {
    /// Frame whose image is to be sent.
    pub due: Option<(u32, Micros)>,
    /// Frame that the next image differs from; none: it is a key frame.
    pub base: Option<u32>,
    /// Time of the last key frame.
    key: Micros,
    last: ImageReference<TAXELS>,
}

impl<const TAXELS: usize> ImageQueue<TAXELS> {
    pub const fn new() -> Self {
        ImageQueue { due: None, base: None, key: Micros(0), last: ImageReference::new() }
    }

    /// Forgets the image sent last: that of another garment.
    pub fn clear(&mut self) {
        self.base = None;
        self.last.clear();
    }

    /// Encodes the image that is due; returns false if the message does not fit. An image without room for its
    /// code is thinned. A key frame takes longer to encode, so a light frame shortly before it is due becomes
    /// it.
    pub fn put(
        &mut self,
        tx_frame: &mut TxFrame,
        about: &About<'_>,
        key_us: u64,
        health: &mut Health,
    ) -> bool {
        let Some((frame, time)) = self.due.take() else { return true };
        let rest_us = key_us.saturating_sub(time.since(self.key));
        let is_light = || measures_little(about.present, about.form_ages);
        let is_key_due = rest_us == 0 || rest_us <= key_us / 16 && is_light();
        let against = self.base.filter(|_| !is_key_due);
        let layout = &about.setup.layout;
        let Some(length) = self.last.advance(layout, about.image, against.is_none(), tx_frame.scratch())
        else {
            self.clear();
            health.thinned_frames += 1;
            return true;
        };
        let head = Frame { frame, time, base: against, sum: self.last.sum(), data: &[] };
        let fits = tx_frame.put_data(Report::FRAME, &head, length);
        self.base = fits.then_some(frame);
        if fits && against.is_none() {
            self.key = time;
        }
        fits
    }
}

/// True if no contact that is larger than the mean has its form measured in this frame, or in the next one,
/// when the rest of the message is sent. Unlike a measured time, this is the same on every machine.
fn measures_little(present: &[Placed], form_ages: &[u8]) -> bool {
    let area = |placed: &Placed| u32::from(placed.contact.area);
    let all: u32 = present.iter().map(area).sum();
    let oldest = form_ages.iter().max();
    let turns = present.iter().zip(form_ages).filter(|(_, age)| **age == 0 || Some(*age) == oldest);
    turns.map(|(placed, _)| area(placed)).all(|area| area * present.len() as u32 <= all)
}

/// Raw codes to be sent, kept until the link has room.
#[cfg(feature = "raw")]
type CodeVec<const TAXELS: usize> = Vec<Code, TAXELS>;
#[cfg(not(feature = "raw"))]
type CodeVec<const TAXELS: usize> = Vec<Code, 0>;

/// The raw codes to send.
pub(super) struct RawQueue<const TAXELS: usize> {
    /// Frame whose codes are to be sent.
    pub due: Option<(u32, Micros)>,
    rate: Pace,
    codes: CodeVec<TAXELS>,
}

impl<const TAXELS: usize> RawQueue<TAXELS> {
    pub const fn new() -> Self {
        RawQueue { due: None, rate: Pace::NEVER, codes: CodeVec::new() }
    }

    /// Sets the frames per second.
    pub fn pace(&mut self, hz: u16) {
        self.rate = Pace::new(hz);
    }

    /// Takes the codes of a frame. Codes that wait are replaced by newer ones.
    pub fn take(&mut self, (frame, time): (u32, Micros), codes: &[Code]) {
        if self.rate.due(time) || self.due.is_some() {
            self.due = Some((frame, time));
            self.codes.clear();
            let _ = self.codes.extend_from_slice(codes);
        }
    }

    /// Encodes the codes that are due; returns false if they do not fit.
    pub fn put(&mut self, tx_frame: &mut TxFrame) -> bool {
        let Some((frame, time)) = self.due.take() else { return true };
        let mut plain = [0; TAXELS];
        for (value, code) in plain.iter_mut().zip(&self.codes) {
            *value = code.0;
        }
        let plain = plain.get(..self.codes.len()).unwrap_or(&[]);
        let length = encode_image(plain, None, tx_frame.scratch());
        let head = Raw { frame, time, data: &[] };
        length.is_some_and(|length| tx_frame.put_data(Report::RAW, &head, length))
    }
}
