//! A board whose clock jumps to any 64-bit time and back.

use super::stage::{frame, hello, hello_of};
use crate::sink::Sink;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use taxel::client::{Client, Stamps};
use taxel::json::MessagePrinter;
use taxel::record::{Plan, PlannedBoard, Recorder};
use taxel::session::Observer;
use taxel::source::{self, SourceOptions};
use taxel_cli::commands::recordings::export::{self, ExportArgs, Form};
use taxel_cli::report::{self, Seen};
use taxel_cli::terminal::{Lines, View};
use taxel_cli::view::{PageHub, Player, Viewer};
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{
    ContactList, Frame, Health, IntentReport, Level, Log, Report, SyncReport, encode_image, image_bound,
    image_sum,
};

const TIMES: [u64; 12] = [
    1_000,
    u64::MAX,
    6_000,
    1 << 63,
    u64::MAX / 1000,
    u64::MAX / 1000 + 1,
    11_000,
    (1 << 63) - 1,
    u64::MAX - 1,
    16_000,
    1 << 53,
    21_000,
];

/// A key frame, and all other messages with a time, for each of these times.
fn said() -> Vec<u8> {
    let garment = Garment::block();
    let mut bytes = hello(0, &garment, &Scene::shipped(), "taxel");
    let values = [7; 64];
    let mut data = vec![0; image_bound(values.len(), u16::BITS)];
    let length = encode_image(&values, None, &mut data).unwrap();
    let mut seq = 0;
    for (number, time) in (1u32..).zip(TIMES) {
        let time = Micros(time);
        let image = Frame { frame: number, time, base: None, sum: image_sum(&values), data: &data[..length] };
        let intent = IntentReport {
            frame: number,
            time,
            leading: taxel_core::intent::Leading::None,
            outcome: taxel_core::intent::Outcome::Unsettled,
            steps: 1,
            concepts: Default::default(),
        };
        for report in [
            Report::Frame(image),
            Report::Contacts(ContactList { frame: number, time, ..ContactList::default() }),
            Report::Intent(intent),
            Report::Health(Health { time, ..Health::default() }),
            Report::Log(Log { time, level: Level::Warn, text: "tick" }),
            Report::Sync(SyncReport { token: number, received: time, sent: time }),
        ] {
            seq += 1;
            bytes.extend(frame(seq, &report));
        }
        let [garment, scene] =
            [postcard::to_allocvec(&garment).unwrap(), postcard::to_allocvec(&Scene::shipped()).unwrap()];
        seq += 1;
        bytes.extend(hello_of(seq, &garment, &scene, "taxel", time));
    }
    bytes
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("times-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Shows this board's messages in every way, and records them. Returns the recording.
fn shown(name: &str, ros2: bool) -> PathBuf {
    let path = folder(name).join("it.mcap");
    let source = source::open(&"sim:idle".parse().unwrap(), &SourceOptions::default()).unwrap();
    let plan = Plan { ros2, force: true, ..Plan::of(&path, PlannedBoard::default()) };
    let recorder = Recorder::create(plan).unwrap();
    let mut shows: Vec<Box<dyn Observer>> = vec![
        Box::new(Viewer::new(Arc::new(PageHub::default()), None)),
        Box::new(Lines::new(Sink::default())),
        Box::new(MessagePrinter::new(true, Sink::default())),
        Box::new(recorder.board(0)),
    ];
    #[cfg(feature = "foxglove")]
    shows.push(Box::new(taxel_cli::foxglove::Publisher::new(Arc::new(
        taxel_cli::foxglove::FoxgloveHub::default(),
    ))));
    shows.opened(&source).unwrap();
    let mut stamps = Stamps::start();
    let (mut client, mut view) = (Client::new(), View::new(&source));
    let mut seen = Seen::new("it".into());
    // A host that requests the time, so that answers count as round trips.
    client.start(0).unwrap();
    for (now, part) in (1_000_000u64..).step_by(50_000).zip(said().chunks(200)) {
        client.set_time(now);
        client.take_requests();
        for byte in part {
            let Some(event) = client.push(*byte) else { continue };
            view.event(&client, &event);
            let stamp = stamps.of(&client, &event);
            seen.event(&client, &event, stamp).unwrap();
            shows.event(&client, &event, stamp).unwrap();
        }
        shows.idle(&mut client).unwrap();
    }
    let stamp = stamps.now(&client);
    shows.ended(&client, stamp).unwrap();
    seen.ended(&client, stamp).unwrap();
    recorder.finish().unwrap();
    assert!(report::page(&seen).unwrap().contains("tick"));
    path
}

#[test]
fn times_up_to_the_last_overflow_nowhere() {
    let path = shown("all", true);
    let hub = Arc::new(PageHub::default());
    Player::open(&path.as_path().into(), 1.0, None, None, hub.clone()).unwrap();
    for form in [Form::Csv, Form::Npz, Form::Png] {
        let output = path.with_extension(format!("{form:?}"));
        export::run(ExportArgs::of(path.clone(), form, output.clone())).unwrap();
        assert!(output.exists());
    }
    std::fs::remove_dir_all(path.parent().unwrap()).unwrap();
}
