//! A recording of another wire.

use super::stage::{file, plan, record};
use taxel::record::Play;

#[test]
fn a_recording_of_another_wire_is_refused_in_a_sentence() {
    record("sim:idle", plan("wire-now.mcap", "sim", None, false));
    let mut bytes = std::fs::read(file("wire-now.mcap")).unwrap();
    let name = b", wire 2";
    let at = bytes.windows(name.len()).position(|it| it == name).unwrap();
    // A name of the same length.
    bytes[at..at + name.len()].copy_from_slice(b".0000001");
    std::fs::write(file("wire-old.mcap"), bytes).unwrap();
    let refused = Play::open(&file("wire-old.mcap").into()).err().unwrap().to_string();
    let why =
        "wire-old.mcap: it was recorded with wire 1, and this program reads wire 2: read it with taxel ";
    assert!(refused.contains(why), "{refused}");
}
