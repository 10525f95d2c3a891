//! Tables on the emulated board: they are sent in pieces and kept in flash, over a restart; what presses on the
//! robot, and what is felt where the garment folds, is what the same core says on this machine, also while the
//! robot moves. `cargo xtask test --only emulator-surface`.

pub mod moving;

use crate::board::Emulated;
use crate::twin::{Course, DWELL, RATE_HZ, same, scene};
use std::path::Path;
use taxel::body::{self, Pose, Surface};
use taxel::files::scripts::load;
use taxel::sim::{frame_codes, scale_rate};
use taxel_core::board::TableKind;
use taxel_core::capacity::TAXELS;
use taxel_core::garment::{Garment, Layout};
use taxel_core::wire::{Poses, Request, TABLE_PIECE, TablePiece};
use taxel_suite::folds::FOLDS;

/// More than the codes of a garment at rest, with their noise.
const REST: u16 = 130;
/// Frames of the script that are shown.
const FRAMES: usize = 40;

/// The reference body's table.
pub fn table() -> (&'static [u8], Surface) {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, TAXELS, 4095).unwrap();
    let surface = body::read("reference").unwrap().surface(&garment, &layout).unwrap();
    let table = body::table(&surface, &layout).unwrap();
    (Box::leak(table.into_boxed_slice()), surface)
}

/// Poses of links, as they are sent.
fn sent<'a>(poses: impl Iterator<Item = (&'a String, Pose)>) -> Vec<u8> {
    let links = poses
        .map(|(link, pose)| (link.as_str().try_into().unwrap(), pose.for_board().unwrap(), None))
        .collect();
    postcard::to_allocvec(&Poses { at: None, links }).unwrap()
}

/// A pose of each link but the first, in no special direction.
fn poses(surface: &Surface) -> Vec<u8> {
    let pose = |(index, link)| {
        let turn = [0.3, -0.2, 0.1 * index as f64, 0.9];
        (link, Pose::from_arrays([0.1 * index as f64, -0.7, 1.2], turn))
    };
    sent(surface.links().iter().enumerate().skip(1).map(pose))
}

/// A board that is sent these tables, stores them, and starts again with these codes to come, each frame in so
/// many scans.
fn storing(
    (flash, link): (&str, &str),
    tables: &[(TableKind, &'static [u8])],
    (codes, dwell): (&[u16], u64),
) -> Emulated {
    let flash = Path::new(env!("CARGO_TARGET_TMPDIR")).join(flash);
    let _ = std::fs::remove_file(&flash);
    let dwell = dwell.to_string();
    let options = ["--link", link, "--dwell", &dwell, "--flash", flash.to_str().unwrap()];
    let start = || {
        let mut board = Emulated::start(&Garment::reference(), codes, 0, &options);
        // It hears nothing before it has started.
        board.receive();
        board
    };
    let mut board = start();
    store(&mut board, tables);
    board.end();
    start()
}

/// Sends a board these tables, piece by piece.
pub fn store(board: &mut Emulated, tables: &[(TableKind, &'static [u8])]) {
    for (kind, table) in tables {
        for (index, bytes) in table.chunks(TABLE_PIECE).enumerate() {
            let (length, offset) = (table.len() as u32, (index * TABLE_PIECE) as u32);
            let piece = TablePiece { kind: *kind, length, offset, bytes };
            board.obey(&Request::SetTable(&postcard::to_allocvec(&piece).unwrap()));
        }
    }
}

/// Codes of five contacts, a frame in each 50 ms. Without a tare what rests is to read as no pressure.
fn five() -> Vec<u16> {
    let script = scale_rate(&load("five").unwrap(), 1.0);
    let frames = frame_codes(&script, &Garment::reference(), 1_000_000 / u64::from(RATE_HZ), FRAMES).unwrap();
    frames.into_iter().map(|code| code.saturating_sub(REST)).collect()
}

#[test]
fn what_presses_on_the_robot_is_the_same_on_the_board_and_lasts_over_a_restart() {
    let codes = five();
    let (table, surface) = table();
    let mut scene = scene();
    scene.stream.pressing_hz = u16::MAX;
    let (scene, poses) = (postcard::to_allocvec(&scene).unwrap(), poses(&surface));
    let tables = [(TableKind::Surface, table)];
    let mut board = storing(("surface.bin", "uart"), &tables, (&codes, DWELL));
    let requests = [Request::SetScene(&scene), Request::SetPoses(&poses), Request::Start];
    let course = Course { tables: &tables, requests: &requests, codes: &codes, dwell: DWELL };
    let kinds = same(&mut board, &course, &["Frame", "Contacts", "Pressing"]);
    board.end();
    println!("{kinds:?}");
    assert!(kinds["Pressing"] as usize > FRAMES / 2, "{kinds:?}");
}

/// Nobody sends the posture: the left arm may fold in any way, and only what is stronger is felt there.
#[test]
fn what_folds_is_the_same_on_the_board_and_lasts_over_a_restart() {
    let codes = five();
    let scene = postcard::to_allocvec(&scene()).unwrap();
    let tables = [(TableKind::Folds, &FOLDS.0[..])];
    let mut board = storing(("folds.bin", "uart"), &tables, (&codes, DWELL));
    let requests = [Request::SetScene(&scene), Request::Start];
    let course = Course { tables: &tables, requests: &requests, codes: &codes, dwell: DWELL };
    let kinds = same(&mut board, &course, &["Frame", "Contacts"]);
    board.end();
    println!("{kinds:?}");
    assert!(kinds["Contacts"] as usize > FRAMES / 2, "{kinds:?}");
}
