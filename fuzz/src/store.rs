//! A flash of any content, written by any firmware before or by nothing: a board starts, and what is then
//! saved is loaded.

use crate::bytes::Bytes;
use embedded_storage::nor_flash::{NorFlash, ReadNorFlash};
use taxel::sim::SimFlash;
use taxel_core::board::{Board, BoardInfo, Settings};
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_store::{Found, Store};

type Small = Board<64, 32>;

const INFO: BoardInfo =
    BoardInfo { firmware: "fuzz", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };

/// Bytes of a sector.
const SECTOR: u32 = 4096;

/// Starts a board with a flash that holds the bytes, saves, and starts another.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    // Two sectors or more are set aside; what fits two of them fits more.
    let range = 0..SECTOR * (4 + u32::from(bytes.byte()) % 13);
    let mut flash = content(&mut bytes);
    let mut board = board();
    let _ = Store::new(&mut flash, range.clone()).expect("whole sectors").load(&mut board);
    let mut gain = [4096; 64];
    gain[usize::from(bytes.byte()) % 64] = bytes.short();
    let (garment, scene) = (board.setup().garment.clone(), board.setup().scene.clone());
    let settings = Settings {
        garment: &garment,
        scene: &scene,
        gain: &gain,
        faulty: &[],
        baseline: None,
        calibration: None,
        saves: 5,
    };
    let saved = Store::new(&mut flash, range.clone()).expect("whole sectors").save(&settings);
    assert!(saved.is_ok(), "whatever the flash held, settings find their place: {saved:?}");
    let mut again = self::board();
    let found = Store::new(&mut flash, range).expect("whole sectors").load(&mut again);
    assert_eq!(found, Ok(Found::Settings));
    assert_eq!((&again.setup().garment, &again.setup().scene), (&garment, &scene));
    assert_eq!(again.settings().gain, gain);
}

fn board() -> Box<Small> {
    Box::new(Small::new(INFO, Garment::block(), Scene::shipped()).expect("what ships fits its garments"))
}

/// A flash whose bits have fallen where pieces of the bytes say so; what ships was saved there before if the
/// first byte is odd.
fn content(bytes: &mut Bytes<'_>) -> SimFlash {
    let mut flash = SimFlash::default();
    if bytes.byte() % 2 == 1 {
        let board = board();
        let saved = Store::new(&mut flash, 0..SECTOR * 4).expect("whole sectors").save(&board.settings());
        assert!(saved.is_ok(), "an empty flash takes what ships");
    }
    for _ in 0..bytes.byte() % 16 {
        let place = u32::from(bytes.short());
        for (place, byte) in (place..SimFlash::BYTES).zip(bytes.piece()) {
            let mut held = [0];
            flash.read(place, &mut held).expect("it lies within");
            flash.write(place, &[held[0] & byte]).expect("its bits only fall");
        }
    }
    flash
}
