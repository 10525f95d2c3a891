//! Images as a host keeps them. A part of the targets that receive some.

use crate::board::Message;
pub use taxel_core::capacity::TAXELS;
use taxel_core::wire::{Report, decode_image, image_sum};

/// The last image, to which the next one is a difference.
#[derive(Default)]
pub struct Images {
    last: Option<(u32, Vec<u16>)>,
}

impl Images {
    /// Number and time of the scan of a `Frame`, whose image must be the one that the board had.
    pub fn take(&mut self, message: &Message) -> Option<(u32, u64)> {
        let Report::Frame(frame) = message.report() else { return None };
        let mut image = vec![0; TAXELS];
        let base = frame.base.map(|number| {
            let (last, base) = self.last.as_ref().expect("a difference to no frame");
            assert_eq!(*last, number, "the difference is to another frame");
            base.as_slice()
        });
        decode_image(frame.data, base, &mut image).unwrap();
        assert_eq!(image_sum(&image), frame.sum, "frame {}", frame.frame);
        self.last = Some((frame.frame, image));
        Some((frame.frame, frame.time.0))
    }
}
