//! A request on its way to an offered board, and the words of an answer.

use taxel_core::wire::{LONGEST_REQUEST, Receiver, Request, decode, frame_bound};

/// Longest frame of a request, bytes.
pub const LONGEST_ASK: usize = frame_bound(LONGEST_REQUEST);
/// Most signs of an answer that are shown.
const SIGNS: usize = 200;

/// The frame of one request, as it is sent in a query.
#[derive(Debug)]
pub struct AskedFrame(Receiver<LONGEST_ASK>);

impl Default for AskedFrame {
    fn default() -> AskedFrame {
        AskedFrame(Receiver::new())
    }
}

impl AskedFrame {
    /// Reads the request in this frame. Error if it is not one frame of a request.
    pub fn read<'a>(&'a mut self, frame: &[u8]) -> Result<Request<'a>, String> {
        if frame.len() > LONGEST_ASK {
            return Err(too_long(frame.len()));
        }
        let [begun @ .., end] = frame else { return Err("it has no bytes".into()) };
        if begun.iter().any(|byte| self.0.push(*byte).is_some()) {
            return Err("it is more than one frame".into());
        }
        let message = self.0.push(*end).ok_or("it has no end")?.map_err(|why| why.to_string())?;
        decode(message).map_err(|why| why.to_string())
    }
}

/// Returns what is said of a request that is longer than any.
pub fn too_long(bytes: usize) -> String {
    format!("it has {bytes} bytes, and a request has at most {LONGEST_ASK}")
}

/// Words that somebody in the network has said, as they may be shown: one line, not endless.
pub fn words(said: &[u8]) -> String {
    let said = String::from_utf8_lossy(&said[..said.len().min(4 * SIGNS)]);
    said.chars().take(SIGNS).map(|sign| if sign.is_control() { ' ' } else { sign }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::wire::encode;

    #[test]
    fn a_request_is_read_and_anything_else_refused() {
        let mut room = [0; 64];
        let tare = encode(&Request::Tare { frames: 7 }, &mut room).unwrap().to_vec();
        assert_eq!(AskedFrame::default().read(&tare), Ok(Request::Tare { frames: 7 }));
        let long = vec![1; LONGEST_ASK + 1];
        for (frame, why) in [
            (vec![], "it has no bytes".to_string()),
            (vec![1], "it has no end".to_string()),
            (vec![0], "it has no end".to_string()),
            ([tare.clone(), tare.clone()].concat(), "it is more than one frame".to_string()),
            (long, too_long(LONGEST_ASK + 1)),
        ] {
            assert_eq!(AskedFrame::default().read(&frame), Err(why));
        }
        let mut broken = tare;
        broken[2] ^= 1;
        assert!(AskedFrame::default().read(&broken).is_err());
    }

    #[test]
    fn words_are_one_line_that_ends() {
        assert_eq!(words(b"no\x1b[31m\nroom"), "no [31m room");
        assert_eq!(words(&[0xff; 5000]).chars().count(), SIGNS);
    }
}
