//! Records a scene and the events seen meanwhile.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use taxel::client::{Client, Event, ImageNews, Stamp};
use taxel::files::calibrate::ForceScale;
use taxel::record::{Origin, Plan, PlannedBoard, Recorder, Rotate};
use taxel::session::Observer;
use taxel::source::{self, SourceOptions};
use taxel_cli::watch::{WatchOptions, watch};

/// Events of a board.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Seen {
    /// Number, time (us) and image of each frame.
    pub frames: Vec<(u32, u64, Vec<u16>)>,
    /// All other events, as text.
    pub others: Vec<String>,
    /// Bytes of the wire.
    pub wire: Vec<u8>,
}

impl Observer for Seen {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        client.lines().for_each(|line| self.wire.extend_from_slice(line));
        match event {
            Event::Frame { frame, time, image: ImageNews::Whole, .. } => {
                self.frames.push((*frame, time.0, client.image().unwrap().1.to_vec()));
            }
            other => self.others.push(format!("{other:?} {:?}", client.contacts())),
        }
        Ok(())
    }
}

/// Path of a test's file in a folder of these tests, without the files of an earlier run: a recording without frames
/// would not replace them. Other tests that take this file run at the same time.
pub fn file(name: &str) -> PathBuf {
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder =
            Path::new(env!("CARGO_TARGET_TMPDIR")).join(concat!("record-", env!("CARGO_CRATE_NAME")));
        _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    });
    FOLDER.join(name)
}

/// Plan of a recording.
pub fn plan(name: &str, label: &str, rotate: Option<Rotate>, ros2: bool) -> Plan {
    let origin = Origin { label: label.into(), scale: ForceScale::new(None, Some(1000.0)) };
    let board = PlannedBoard { origin, ..PlannedBoard::default() };
    Plan { rotate, ros2, force: true, ..Plan::of(file(name), board) }
}

/// Records a source. Returns its events.
pub fn record(spec: &str, plan: Plan) -> Seen {
    let (mut seen, recorder) = (Seen::default(), Recorder::create(plan).unwrap());
    let mut board = recorder.board(0);
    play(spec, &mut vec![&mut seen as &mut dyn Observer, &mut board]);
    recorder.finish().unwrap();
    seen
}

/// Shows a source to its end.
pub fn play(spec: &str, observer: &mut dyn Observer) {
    let spec = spec.parse().unwrap();
    let source = source::open(&spec, &SourceOptions::default()).unwrap();
    watch(&WatchOptions::of(spec), source, observer).unwrap();
}
