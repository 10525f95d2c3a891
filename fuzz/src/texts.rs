//! Files that people write, of any bytes: errors are sentences, and what was read and is written is read again
//! as it was.

use crate::bytes::Bytes;
use crate::scratch::Scratch;
use std::path::Path;
use taxel::files::bases::Base;
use taxel::files::calibrate::Calibration;
use taxel::files::{garments, scripts};
use taxel::robot::ReadRobot;
use taxel::sim::{self, World};
use taxel::{fcm, source};
use taxel_cli::commands::board::flash;
use taxel_cli::commands::garment::config;
use taxel_cli::view::message::{self, PageRequest};
use taxel_core::garment::{Garment, Layout};
use taxel_core::gesture::Model;
use taxel_core::intent::{CONCEPTS, EDGES};
use taxel_learn::shapes::labels;
use taxel_learn::touches::Table;

/// A reader of a file.
type Reader = fn(&Scratch, &[u8]);

const READERS: [Reader; 13] = [
    garment,
    scene,
    script,
    calibration,
    map,
    |_, text| _ = fcm::json::parse(&String::from_utf8_lossy(text)),
    base,
    table,
    |file, _| _ = labels::read(file.path(), 4),
    page_request,
    |_, bytes| _ = Model::read(bytes).map(|model| model.notes().len()),
    image,
    robot,
];

/// Reads the bytes as the kind of file that the first of them chooses.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let reader = READERS[usize::from(bytes.byte()) % READERS.len()];
    let text = bytes.rest();
    reader(&Scratch::new(text, "toml"), text);
}

fn page_request(_: &Scratch, text: &[u8]) {
    let Some(PageRequest::Why { of, concepts }) = message::request(&String::from_utf8_lossy(text)) else {
        return;
    };
    let map = fcm::load::map("tactile").expect("the map ships");
    if let Some(why) = message::why(&map, of.as_deref(), &concepts) {
        assert!(why.paths.len() <= 24 && why.sum.is_finite(), "{why:?}");
    }
}

fn garment(file: &Scratch, _: &[u8]) {
    let Ok(read) = garments::read(file.name()) else { return };
    let text = garments::text(&read.garment, "").expect("a garment can be written");
    assert_eq!(garments::parse(&text, "").ok().as_ref(), Some(&read.garment), "{text}");
    let _ = config::check(file.name(), None);
}

fn scene(file: &Scratch, _: &[u8]) {
    let _ = config::check("block-4x16", Some(file.path()));
}

fn script(file: &Scratch, _: &[u8]) {
    let Ok(script) = scripts::load(file.name()) else { return };
    let _ = source::scene_of(&script);
    let garment = Garment::block();
    let layout = Layout::build(&garment, 64, 4095).expect("it ships");
    let home = scripts::garment(&script).ok().and_then(|home| Layout::build(&home, 65_535, 4095).ok());
    let script = home.map_or_else(|| script.clone(), |home| sim::refit(&script, &home, &layout));
    let Ok(world) = World::build(&script, &garment) else { return };
    for t_ns in [0, 500_000_000, u64::MAX] {
        assert!(world.newtons(7, t_ns).is_finite(), "a force is a number");
    }
}

fn calibration(file: &Scratch, _: &[u8]) {
    let Ok(calibration) = Calibration::read(file.path()) else { return };
    let text = calibration.text().expect("a calibration can be written");
    let again = Calibration::parse(&text, "again").expect("what was written is read");
    assert_eq!(calibration.certificate(), again.certificate(), "{text}");
}

fn map(file: &Scratch, _: &[u8]) {
    let Ok(map) = fcm::load::map(file.name()) else { return };
    let text = toml::to_string(&map).expect("a map can be written");
    let again = fcm::load::parse(&text, "again").expect("what was written is read");
    assert_eq!(toml::to_string(&again).as_ref(), Ok(&text));
    let _ = map.to_config::<CONCEPTS, EDGES>();
}

fn base(_: &Scratch, text: &[u8]) {
    let Ok(base) = Base::parse(&String::from_utf8_lossy(text)) else { return };
    let text = base.text().expect("a base can be written");
    assert!(Base::parse(&text).is_ok(), "{text}");
}

fn table(_: &Scratch, text: &[u8]) {
    let Ok(table) = Table::parse(&String::from_utf8_lossy(text)) else { return };
    assert_eq!(table.column("gesture").map_or(table.len(), |column| column.len()), table.len());
}

/// An image of the firmware; a program for a debug probe would be started.
fn image(file: &Scratch, bytes: &[u8]) {
    if !bytes.starts_with(b"\x7fELF") {
        let nowhere = Path::new("no-such-drive").to_path_buf();
        let args = flash::FlashArgs { file: file.path().into(), drive: Some(nowhere) };
        assert!(flash::run(args).is_err(), "there is no drive");
    }
}

/// A robot.
fn robot(_: &Scratch, text: &[u8]) {
    let (text, folder) = (String::from_utf8_lossy(text).into_owned(), Path::new("no-such-folder"));
    let Ok(read) = ReadRobot::parse("robot.toml".into(), text, folder) else { return };
    assert!(!read.boards.is_empty(), "a robot has boards");
}
