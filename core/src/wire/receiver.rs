//! Receiver: turns bytes, in any split, into messages. Whatever came before, it starts anew after each 0x00.

use super::codec::open;
use super::error::WireError;

/// Collects the bytes of a link until a 0x00 and opens the frame before it.
///
/// A frame with a 0x00 on both sides is received, whatever came before the first of them. Only garbage that
/// is directly followed by a frame, without a 0x00 between, destroys that frame. So a sender should begin
/// with a 0x00: empty frames are ignored.
///
/// `N` is the greatest length of a frame without its 0x00; [`frame_bound`](super::frame_bound) gives it for a
/// message. A longer frame is dropped up to its 0x00, and reported there once as [`WireError::TooLong`].
#[derive(Debug, Clone)]
pub struct Receiver<const N: usize> {
    frame: [u8; N],
    /// Number of bytes of the frame so far; `N + 1` if it is too long.
    length: usize,
}

impl<const N: usize> Receiver<N> {
    /// A receiver between two frames.
    pub const fn new() -> Self {
        Receiver { frame: [0; N], length: 0 }
    }

    /// Takes one byte. At a 0x00 that ends a frame, returns the bytes of its message (for
    /// [`decode`](super::decode)), or the error.
    pub fn push(&mut self, byte: u8) -> Option<Result<&[u8], WireError>> {
        if byte != 0 {
            match self.frame.get_mut(self.length) {
                Some(place) => {
                    *place = byte;
                    self.length += 1;
                }
                None => self.length = N.saturating_add(1),
            }
            return None;
        }
        match core::mem::take(&mut self.length) {
            0 => None,
            length => {
                Some(self.frame.get_mut(..length).ok_or(WireError::TooLong).and_then(|frame| open(frame)))
            }
        }
    }

    /// Takes bytes up to the first 0x00 that ends a frame, or all of them. Returns how many it took, and what
    /// [`Receiver::push`] returns of the last one.
    pub fn take(&mut self, bytes: &[u8]) -> (usize, Option<Result<&[u8], WireError>>) {
        let mut taken = 0;
        for part in bytes.split_inclusive(|byte| *byte == 0) {
            let (body, end) = match part.split_last() {
                Some((0, body)) => (body, true),
                _ => (part, false),
            };
            let place = self.frame.get_mut(self.length..).and_then(|rest| rest.get_mut(..body.len()));
            match place {
                Some(place) => {
                    place.copy_from_slice(body);
                    self.length += body.len();
                }
                None => self.length = N.saturating_add(1),
            }
            taken += part.len();
            if end && self.length > 0 {
                return (taken, self.push(0));
            }
        }
        (taken, None)
    }

    /// First byte of the message whose frame has not ended yet, if it has arrived; garbage has one, too.
    pub fn first(&self) -> Option<u8> {
        match self.frame.get(..self.length)? {
            // COBS: a group without data bytes stands for a zero.
            [1, ..] => Some(0),
            [_, first, ..] => Some(*first),
            _ => None,
        }
    }

    /// Drops the bytes of an unfinished frame, for example after the link was closed.
    pub const fn reset(&mut self) {
        self.length = 0;
    }
}

impl<const N: usize> Default for Receiver<N> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Results at each 0x00.
    fn ends<const N: usize>(receiver: &mut Receiver<N>, bytes: &[u8], want: &[WireError]) {
        let mut want = want.iter();
        for byte in bytes {
            if let Some(end) = receiver.push(*byte) {
                assert_eq!(end.err().as_ref(), want.next());
            }
        }
        assert_eq!(want.next(), None);
    }

    #[test]
    fn the_first_byte_of_a_message_is_known_before_its_end() {
        let mut wire = [0; 64];
        for message in [[0u8, 7, 0], [1, 0, 5], [200, 3, 1], [0, 0, 0]] {
            let frame = super::super::codec::encode(&message, &mut wire).unwrap();
            let mut receiver = Receiver::<64>::new();
            assert_eq!(receiver.first(), None);
            let (end, body) = frame.split_last().unwrap();
            body.iter().for_each(|byte| assert!(receiver.push(*byte).is_none()));
            assert_eq!(receiver.first(), Some(message[0]));
            assert_eq!(receiver.push(*end).unwrap().unwrap(), message);
            assert_eq!(receiver.first(), None);
        }
    }

    #[test]
    fn bytes_taken_together_are_what_they_are_one_by_one() {
        let bytes = [0, 0, 3, 9, 9, 0, 1, 1, 1, 1, 1, 1, 0, 9, 9, 9, 9, 9, 9, 9, 9, 0, 0, 5, 0, 7];
        for pieces in 1..=bytes.len() {
            let (mut one, mut all) = (Receiver::<6>::new(), Receiver::<6>::new());
            for piece in bytes.chunks(pieces) {
                let mut rest = piece;
                while !rest.is_empty() {
                    let (taken, end) = all.take(rest);
                    let mut wanted = None;
                    let (now, later) = rest.split_at(taken);
                    for (left, byte) in (0..taken).rev().zip(now) {
                        wanted = one.push(*byte).map(|end| end.map(<[u8]>::len));
                        assert!(wanted.is_none() || left == 0, "{pieces}");
                    }
                    assert_eq!(end.map(|end| end.map(<[u8]>::len)), wanted, "{pieces}");
                    rest = later;
                }
            }
        }
    }

    #[test]
    fn too_long_is_reported_once_and_a_full_buffer_is_not_too_long() {
        let mut receiver = Receiver::<6>::new();
        ends(&mut receiver, &[0, 0, 0], &[]);
        ends(&mut receiver, &[1, 1, 1, 1, 1, 1, 0], &[WireError::Crc]);
        ends(&mut receiver, &[1, 1, 1, 1, 1, 1, 1, 0, 0], &[WireError::TooLong]);
        ends(&mut receiver, &[9; 100], &[]);
        ends(&mut receiver, &[0, 0, 1, 0], &[WireError::TooLong, WireError::TooShort]);
        ends(&mut receiver, &[9; 100], &[]);
        receiver.reset();
        ends(&mut receiver, &[9, 1, 1, 1, 1, 1, 0], &[WireError::Cobs]);
        ends(&mut Receiver::<0>::default(), &[0, 5, 5, 0, 0, 5, 0], &[WireError::TooLong; 2]);
    }
}
