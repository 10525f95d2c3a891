//! A board whose bytes the page carries: however they are cut, and whatever is lost, the events are the same. Leaves the
//! pieces and the lines of it to the tests of the page, whose client in WebAssembly must print the same.

use std::path::Path;
use taxel::client::Client;
use taxel::source::{self, SourceOptions, SourceSpec};
use taxel_site::lines_of;

/// Number of pieces, some of which are lost or damaged.
const PIECES: usize = 10_000;
/// Bytes at the beginning that come whole: without answers the client asks again, by the clock of this machine.
const WHOLE: usize = 20_000;

/// What a simulated board sends that is asked for its whole stream.
fn sent() -> Vec<u8> {
    let mut source = source::open(&SourceSpec::Sim("five".into()), &SourceOptions::default()).unwrap();
    let mut client = Client::new();
    client.start(source.tare).unwrap();
    source.port.write(&client.take_requests()).unwrap();
    let (mut all, mut buffer) = (Vec::new(), vec![0; 1 << 16]);
    while let Some(count) = source.port.read(&mut buffer).unwrap() {
        all.extend_from_slice(&buffer[..count]);
    }
    all
}

/// Cuts bytes into pieces, of which every fiftieth is lost, and every fiftieth damaged.
fn cut(bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut random = 0x2545_f491_4f6c_dd1d_u64;
    let mut below = |end: usize| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random % end as u64) as usize
    };
    let mean = bytes.len() / PIECES;
    let (mut pieces, mut from) = (Vec::new(), 0);
    while from < bytes.len() {
        let to = (from + 1 + below(2 * mean)).min(bytes.len());
        let mut piece = bytes[from..to].to_vec();
        match below(50) {
            0 if from >= WHOLE => piece.clear(),
            1 if from >= WHOLE => {
                let at = below(piece.len());
                piece[at] ^= 1 << below(8);
            }
            _ => {}
        }
        pieces.push(piece);
        from = to;
    }
    pieces
}

#[test]
fn pieces_and_losses_give_the_events_of_the_whole() {
    let bytes = sent();
    assert!(bytes.len() > 20 * PIECES, "{} bytes", bytes.len());
    let pieces = cut(&bytes);
    assert!(pieces.len() > PIECES * 9 / 10, "{} pieces", pieces.len());
    let lines = lines_of(pieces.iter().map(Vec::as_slice)).unwrap();
    let whole = pieces.concat();
    assert_eq!(lines, lines_of(std::iter::once(whole.as_slice())).unwrap());
    let text = String::from_utf8(lines).unwrap();
    let (events, unharmed) = (text.lines().count(), lines_of(std::iter::once(bytes.as_slice())).unwrap());
    let undamaged = unharmed.iter().filter(|byte| **byte == b'\n').count();
    assert!(events > 500 && text.contains("\"refused\"") && events != undamaged, "{events} {undamaged}");
    let pieces: Vec<u8> = pieces
        .iter()
        .flat_map(|piece| [&(piece.len() as u32).to_le_bytes(), piece.as_slice()].concat())
        .collect();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join("serial.pieces"), pieces).unwrap();
    std::fs::write(folder.join("serial.lines"), text).unwrap();
}
