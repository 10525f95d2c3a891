//! Records a scene and the events seen meanwhile.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use taxel::client::{Client, Event, ImageNews};
use taxel::record::{Origin, Plan, Recorder, Rotate};
use taxel::session::Show;
use taxel::source::{self, SourceOptions};
use taxel_cli::watch::{LiveArgs, watch};

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

impl Show<anyhow::Error> for Seen {
    fn event(&mut self, client: &Client, event: &Event) -> anyhow::Result<()> {
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

/// Shows and records at once.
struct Both<'a>(&'a mut Seen, &'a mut Recorder);

impl Show<anyhow::Error> for Both<'_> {
    fn event(&mut self, client: &Client, event: &Event) -> anyhow::Result<()> {
        self.0.event(client, event)?;
        self.1.event(client, event)
    }

    fn asked(&mut self, client: &Client, bytes: &[u8]) -> anyhow::Result<()> {
        self.1.asked(client, bytes)
    }

    fn idle(&mut self, client: &mut Client) -> anyhow::Result<bool> {
        self.1.idle(client)
    }

    fn end(&mut self, client: &Client) -> anyhow::Result<()> {
        self.1.end(client)
    }
}

/// Path of a test's file in the build folder, without the files of an earlier run: a recording without frames would
/// not replace them.
pub fn file(name: &str) -> PathBuf {
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("record");
        _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    });
    FOLDER.join(name)
}

/// Plan of a recording.
pub fn plan(name: &str, label: &str, rotate: Option<Rotate>, ros2: bool) -> Plan {
    Plan {
        path: file(name),
        rotate,
        ros2,
        body: None,
        force: true,
        inputs: Vec::new(),
        origin: Origin { label: label.into(), counts_per_newton: Some(1000.0), calibration: None },
    }
}

/// Records a source. Returns its events.
pub fn record(spec: &str, plan: Plan) -> Seen {
    let (mut seen, mut recorder) = (Seen::default(), Recorder::create(plan).unwrap());
    play(spec, &mut Both(&mut seen, &mut recorder));
    seen
}

/// Shows a source to its end.
pub fn play(spec: &str, show: &mut dyn Show<anyhow::Error>) {
    let spec = spec.parse().unwrap();
    let source = source::open(&spec, &SourceOptions::default()).unwrap();
    watch(&LiveArgs::of(spec), source, show).unwrap();
}
