//! A recording of any bytes, or of any records behind valid checksums: every reader ends, and what `repair`
//! writes is whole.

use crate::bytes::Bytes;
use crate::mcap;
use crate::scratch::Scratch;
use std::path::Path;
use taxel::recording::{
    BoardRecording, Clips, Messages, Overview, chunk_indexes, footer, force_scale, repair, scan, summary,
};

/// How many bytes a recording may hold per byte of its file: LZ4 packs 255 into one.
const MOST: usize = 255;

/// Reads the bytes as a recording in every way there is: as they are, or as its records, as the first of them
/// says.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    match bytes.byte() % 2 {
        0 => read(bytes.rest()),
        _ => read(&mcap::recording(&mut bytes)),
    }
}

fn read(data: &[u8]) {
    let file = Scratch::new(data, "mcap");
    let path = file.path();
    // Each of them may say that the file is none of its kind.
    let _ = (summary(path), footer(path), chunk_indexes(path));
    let messages = count(path, data.len());
    if let Ok(overview) = Overview::of(path) {
        let board = BoardRecording { board: Some("x".into()), ..path.display().to_string().as_str().into() };
        let _ = (
            overview.messages("/taxel/wire"),
            force_scale(&overview, &board).is_ok(),
            overview.attached("x"),
        );
    }
    clips(path);
    let Ok(found) = scan(path) else { return };
    let _ = (Overview::found(path, &found).messages("/taxel/wire"), found.damaged());
    let mut rebuilt = Vec::new();
    let length = repair(path, &found, &mut rebuilt).expect("what was found can be written");
    assert_eq!(length, rebuilt.len() as u64);
    let rebuilt = Scratch::new(&rebuilt, "mcap");
    assert!(scan(rebuilt.path()).expect("it was written here").whole, "a repaired recording is whole");
    let kept = count(rebuilt.path(), usize::MAX);
    // Of a file that is damaged, a reader may take other bytes for records than `repair` does.
    let is_sound = found.damage.is_empty() && found.corrected == 0;
    assert!(kept >= messages || !is_sound, "{messages} messages can be read, and {kept} of them are kept");
}

/// Messages that can be read; each file has an end.
fn count(path: &Path, bytes: usize) -> usize {
    let Ok(mut messages) = Messages::open(path) else { return 0 };
    let mut count = 0;
    while let Some(message) = messages.next_message().expect("a file that is damaged is no error") {
        let _ = message.data.len();
        count += 1;
        assert!(count <= bytes.saturating_mul(MOST), "a file of {bytes} bytes holds {count} messages");
    }
    let [passed, all] = messages.passed();
    assert!(passed <= all, "{passed} of {all} bytes were passed");
    count
}

fn clips(path: &Path) {
    let Ok(mut clips) = Clips::open(&path.into(), "/taxel/wire") else { return };
    for chunk in 0..clips.places().len() {
        let _ = clips.clip(chunk);
    }
}
