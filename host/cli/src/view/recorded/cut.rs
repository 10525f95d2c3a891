//! A part of a recording as a recording of its own, which begins with the state at its first image.

use super::reel::Reel;
use super::survey::Survey;
use crate::view::tape::{Copy, Saved};
use anyhow::{Context, Result};
use std::sync::Arc;
use taxel::client::{Client, Event, Stamp};
use taxel::record::Origin;
use taxel::recording::{ClipMessage, Clips, Store, renumbered, sequence};
use taxel_core::format::Micros;
use taxel_core::wire::{Frame, Report, encode, encode_image, frame_bound, image_bound, image_sum};

/// Longest frame of the wire.
const LONGEST: usize = 8192;

/// Source of the parts.
#[derive(Debug)]
pub struct Cut {
    clips: Clips,
    survey: Arc<Survey>,
    origin: Origin,
}

impl Cut {
    /// Cuts from this recording.
    pub fn new(clips: Clips, survey: Arc<Survey>, origin: Origin) -> Cut {
        Cut { clips, survey, origin }
    }
}

impl Saved for Cut {
    fn write(&self, [from, to]: [u64; 2], store: &mut dyn Store) -> Result<()> {
        let mut reel =
            Reel::new(self.clips.again()?, self.survey.clone(), Vec::new(), self.origin.scale.clone());
        let mut copy = Copy::begin(store, self.origin.clone())?;
        let no_image = "the recording holds no image";
        let (_, event) = reel.seek(from).context(no_image)?;
        let mut piece = reel.shown().context(no_image)?;
        let frame = match alone(reel.client(), &event, sequence(&piece.data)?) {
            Some(frame) => frame,
            None => {
                // Too long as a key frame: begin at the key frame before it.
                piece = reel.show_key().context(no_image)?;
                piece.data.to_vec()
            }
        };
        let (retained, next) = (reel.retained().frames(), sequence(&piece.data)?);
        let first = next.wrapping_sub(retained.len() as u32);
        for (bytes, number) in retained.iter().zip(0u32..) {
            copy.take(stamp(&piece), &renumbered(bytes, first.wrapping_add(number))?)?;
        }
        copy.take(stamp(&piece), &frame)?;
        while let Some((_, piece)) = reel.peek().filter(|(at, _)| *at <= to) {
            copy.take(stamp(&piece), &piece.data)?;
            reel.pass();
        }
        copy.finish()
    }
}

/// Recorded times of a message.
fn stamp(piece: &ClipMessage) -> Stamp {
    Stamp::recorded(piece.header.log_time, piece.header.publish_time)
}

/// The client's image as a key frame; none if it is longer than any frame.
fn alone(client: &Client, event: &Event, seq: u32) -> Option<Vec<u8>> {
    let Event::Frame { time: Micros(time), .. } = event else { return None };
    let (frame, image) = client.image()?;
    let mut data = vec![0; image_bound(image.len(), u16::BITS)];
    let length = encode_image(image, None, &mut data)?;
    let (time, sum) = (Micros(*time), image_sum(image));
    let report = Report::Frame(Frame { frame, time, base: None, sum, data: data.get(..length)? });
    let mut room = vec![0; frame_bound(length + 64)];
    let bytes = encode(&(seq, &report), &mut room).ok()?;
    (bytes.len() <= LONGEST).then(|| bytes.to_vec())
}
