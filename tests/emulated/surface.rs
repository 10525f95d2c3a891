//! The surface on the emulated board: its table is sent in pieces and kept in flash, over a restart, and what
//! presses on the robot is what the same core says on this machine. `cargo xtask test --only
//! emulator-surface`.

use crate::board::Emulated;
use crate::twin::{DWELL, RATE_HZ, same, scene};
use std::path::Path;
use taxel::body::{self, Pose, Surface};
use taxel::files::scripts::load;
use taxel::sim::{frame_codes, scale_rate};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Name, name};
use taxel_core::garment::{Garment, Layout};
use taxel_core::wire::{Request, TABLE_PIECE, TablePiece};

/// More than the codes of a garment at rest, with their noise.
const REST: u16 = 130;
/// Frames of the script that are shown.
const FRAMES: usize = 40;

/// The reference body's table.
fn table() -> (&'static [u8], Surface) {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, TAXELS, 4095).unwrap();
    let surface = body::read("reference").unwrap().surface(&garment, &layout).unwrap();
    let table = body::table(&surface, &layout).unwrap();
    (Box::leak(table.into_boxed_slice()), surface)
}

/// A pose of each link but the first, in no special direction.
fn poses(surface: &Surface) -> Vec<u8> {
    let pose = |(index, link): (usize, &String)| {
        let pose = Pose::from_arrays([0.1 * index as f64, -0.7, 1.2], [0.3, -0.2, 0.1 * index as f64, 0.9]);
        let pose = pose.for_board().unwrap();
        (name(link), pose)
    };
    let poses: Vec<(Name, taxel_core::surface::Pose)> =
        surface.links().iter().enumerate().skip(1).map(pose).collect();
    postcard::to_allocvec(&poses).unwrap()
}

#[test]
fn what_presses_on_the_robot_is_the_same_on_the_board_and_lasts_over_a_restart() {
    let flash = Path::new(env!("CARGO_TARGET_TMPDIR")).join("surface.bin");
    let _ = std::fs::remove_file(&flash);
    let dwell = DWELL.to_string();
    let options = ["--dwell", &dwell, "--flash", flash.to_str().unwrap()];
    let garment = Garment::reference();
    // Five contacts, a frame in each 50 ms.
    let script = scale_rate(&load("five").unwrap(), 1.0);
    let frames = frame_codes(&script, &garment, 1_000_000 / u64::from(RATE_HZ), FRAMES).unwrap();
    // Without a tare what rests is to read as no pressure.
    let codes: Vec<u16> = frames.into_iter().map(|code| code.saturating_sub(REST)).collect();
    let (table, surface) = table();
    let (scene, poses) = (postcard::to_allocvec(&scene()).unwrap(), poses(&surface));

    let mut board = Emulated::start(&garment, &codes, 0, &options);
    board.receive();
    for (index, bytes) in table.chunks(TABLE_PIECE).enumerate() {
        let piece = TablePiece { length: table.len() as u32, offset: (index * TABLE_PIECE) as u32, bytes };
        board.obey(&Request::SetSurface(&postcard::to_allocvec(&piece).unwrap()));
    }
    board.end();

    let mut board = Emulated::start(&garment, &codes, 0, &options);
    board.receive();
    let requests = [
        Request::SetScene(&scene),
        Request::SetPoses(&poses),
        Request::SetPressing(u16::MAX),
        Request::Start,
    ];
    let kinds = same(&mut board, Some(table), &requests, &codes, &["Frame", "Contacts", "Pressing"]);
    board.end();
    println!("{kinds:?}");
    assert!(kinds["Pressing"] as usize > FRAMES / 2, "{kinds:?}");
}
