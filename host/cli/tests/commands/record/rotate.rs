//! A recording in several files, each of which stands alone.

use super::replayed::replayed;
use super::stage::{Seen, file, plan, record};
use std::time::Duration;
use taxel::record::Rotate;

#[test]
fn every_file_stands_alone_and_none_lacks_a_frame() {
    let rotate = Some(Rotate::After(Duration::from_secs(1)));
    let seen = record("sim:five", plan("rotated.mcap", "sim", rotate, false));
    let mut all = Seen::default();
    let mut lengths = Vec::new();
    for number in 1.. {
        let name = if number == 1 { "rotated.mcap".to_string() } else { format!("rotated-{number:04}.mcap") };
        if !file(&name).exists() {
            break;
        }
        let part = replayed(&file(&name));
        assert_eq!(taxel::recording::scan(&file(&name)).unwrap().contents.attachments().count(), 4);
        lengths.push(part.frames.len());
        all.frames.extend(part.frames);
        std::fs::remove_file(file(&name)).unwrap();
    }
    // A second has 195 frames; a key frame, and with it a file, begins up to 62 ms early.
    let (_, whole) = lengths.split_last().unwrap();
    assert!(!whole.is_empty() && whole.iter().all(|frames| (180..=200).contains(frames)), "{lengths:?}");
    assert!(all.frames == seen.frames);
}

#[test]
fn a_file_that_is_there_is_not_written_over() {
    std::fs::write(file("there.mcap"), "precious").unwrap();
    let careful = taxel::record::Plan { force: false, ..plan("there.mcap", "sim", None, false) };
    let error = taxel::record::Recorder::create(careful).unwrap_err().to_string();
    assert!(
        error.ends_with("there.mcap already exists: give another name, or --force to replace it"),
        "{error}"
    );
    assert_eq!(std::fs::read(file("there.mcap")).unwrap(), b"precious");
}

#[test]
fn a_file_is_replaced_once_frames_are_in_the_new_one() {
    let names = ["replaced.mcap", "replaced.ros2.mcap"];
    let kept = || names.map(|name| std::fs::read(file(name)).unwrap() == b"precious");
    names.iter().for_each(|name| std::fs::write(file(name), "precious").unwrap());
    let begin = || taxel::record::Recorder::create(plan("replaced.mcap", "sim", None, true)).unwrap();
    drop(begin());
    assert_eq!(kept(), [true; 2], "given up before a frame came");
    let error = begin().finish().unwrap_err().to_string();
    assert!(error.ends_with("replaced.mcap stays as it was: no frames came"), "{error}");
    assert_eq!(kept(), [true; 2]);
    record("sim:press", plan("replaced.mcap", "sim", None, true));
    assert_eq!(kept(), [false; 2]);
}
