//! Bytes as a message of the wire: their frame is intact, whatever they are.

use serde::ser::{Serialize, SerializeTuple, Serializer};
use taxel_core::wire::{encode, frame_bound};

/// Bytes that are written as they are, without their number before them.
struct Plain<'a>(&'a [u8]);

impl Serialize for Plain<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(self.0.len())?;
        self.0.iter().try_for_each(|byte| tuple.serialize_element(byte))?;
        tuple.end()
    }
}

/// The frame of a message of these bytes, with CRC and COBS in order; empty: there are no bytes.
pub fn framed(message: &[u8]) -> Vec<u8> {
    let mut room = vec![0; frame_bound(message.len())];
    encode(&Plain(message), &mut room).map(<[u8]>::to_vec).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::{Request, decode, open};

    #[test]
    fn the_bytes_of_a_message_are_that_message() {
        let mut frame = framed(&[2, 200, 1]);
        assert_eq!(frame.pop(), Some(0));
        let message = decode::<Request<'_>>(open(&mut frame).unwrap()).unwrap();
        assert_eq!(message, Request::Sync { token: 200 });
        assert!(framed(&[]).is_empty());
    }
}
