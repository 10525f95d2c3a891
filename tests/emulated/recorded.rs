//! Recorded people on a mat, perceived by the firmware image on the emulated board and by the same core on
//! this machine: the reports must be the same, byte for byte. `cargo xtask test --only emulator-recorded`.

use crate::board::Emulated;
use crate::data;
use crate::twin::{Course, DWELL, FULL_SCALE, RATE_HZ, same, scene};
use std::path::PathBuf;
use taxel::files::arrays::read_all;
use taxel_core::garment::Garment;
use taxel_core::gesture::GestureConfig;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// Of a recording, every so many frames.
const STEP: usize = 16;

/// The recordings in `folder` whose names end like that.
fn files(folder: &str, end: &str) -> Vec<PathBuf> {
    let listed = std::fs::read_dir(data::find(folder)).expect("a folder");
    let mut files: Vec<PathBuf> = listed.map(|file| file.unwrap().path()).collect();
    files.retain(|path| path.to_string_lossy().ends_with(end));
    files.sort();
    assert!(!files.is_empty(), "{folder} holds no *{end}");
    files
}

/// Every 16th frame of each posture and its last, and all trousers, as codes.
fn codes() -> Vec<u16> {
    let mut codes = Vec::new();
    for path in [files("pmatdata", ".npz"), files("smart_garment", "-pants.npy")].concat() {
        for (name, frames) in read_all(&path).unwrap() {
            assert_eq!((frames.rows, frames.columns), (64, 32), "{} {name}", path.display());
            let last = frames.count - 1;
            let kept = frames.iter().enumerate().filter(|(n, _)| n % STEP == 0 || *n == last);
            codes.extend(kept.flat_map(|(_, frame)| frame).map(|value| (*value).min(FULL_SCALE)));
        }
    }
    codes
}

#[test]
fn recorded_people() {
    let codes = codes();
    let garment = postcard::to_allocvec(&Garment::mat()).unwrap();
    // A person on a mat makes no gestures; what the model says of them must be the same all the same.
    let gestures =
        GestureConfig { rate_hz: RATE_HZ, decide_ms: 50, onset_ms: 50, lead: 0, ..GestureConfig::default() };
    let scene = postcard::to_allocvec(&Scene { gestures: Some(gestures), ..scene() }).unwrap();
    let requests = [Request::SetGarment(&garment), Request::SetScene(&scene), Request::Start];
    let mut board = Emulated::start(&Garment::mat(), &codes, 0, &["--dwell", &DWELL.to_string()]);
    // It hears nothing before it has started.
    board.receive();
    let kinds = ["Frame", "Contacts", "Symbols", "Intent", "Reaction", "Gesture"];
    let course = Course { tables: &[], requests: &requests, codes: &codes, dwell: DWELL };
    let counts = same(&mut board, &course, &kinds);
    board.end();
    assert!(
        ["Contacts", "Symbols", "Intent", "Frame", "Gesture"].iter().all(|kind| counts.contains_key(kind))
    );
}
