//! The command `taxel report`.

use crate::fault::Fault;
use crate::folding::Folding;
use crate::on_robot::ShownRobot;
use crate::report::{Seen, page};
use crate::watch::{self, Overwrite, WatchOptions};
use anyhow::{Result, bail};
use clap::Args;
use std::path::{Path, PathBuf};
use taxel::client::{Event, Stamp};
use taxel::files::output::Output;
use taxel::record::Play;
use taxel::recording::BoardRecording;
use taxel::session::Observer;
use taxel::source::{self, SourceOptions, SourceSpec};
use taxel::text::progress::{Progress, Unit};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel report touch.mcap -o report.html
  taxel report --source sim:source -o source.html";

/// Write one page about a recording or a board
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ReportArgs {
    /// Recording: .mcap, of a robot .mcap#BOARD
    #[arg(conflicts_with = "source")]
    pub file: Option<BoardRecording>,
    /// In place of a recording: `sim[:TOUCHES]`, `usb`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT` or
    /// `zenoh:ROBOT/BOARD`
    #[arg(long, value_name = "SOURCE")]
    pub source: Option<SourceSpec>,
    /// Page to write (.html), `-` for standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Whether an existing page is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Also show the garment on the robot: the body, a TOML file or `reference`
    #[arg(long, value_name = "BODY")]
    pub body: Option<String>,
    /// The robot that carries the body: a URDF file or `reference`
    #[arg(long, value_name = "URDF", requires = "body")]
    pub robot: Option<String>,
    /// Positions of joints, deg, rad or m: elbow=30deg,wrist=-0.5rad; the others rest
    #[arg(long, value_name = "JOINTS", requires = "robot")]
    pub joints: Option<String>,
    /// Also show where the garment folds: the table, a file of `taxel body learn`; a simulated board has it
    #[arg(long, value_name = "FILE")]
    pub folds: Option<PathBuf>,
    /// Stop after this time of the board, such as 2s or 10min [default: 10 for a real board; a simulated scene is played
    /// once]
    #[arg(long = "for", value_name = "TIME", value_parser = watch::time, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
}

/// Default duration for a real board, s.
const WATCHED: f64 = 10.0;

/// Runs the command.
pub fn run(args: ReportArgs) -> Result<()> {
    let read = |body: &String| {
        ShownRobot::read(body, args.robot.as_deref(), args.joints.as_deref().unwrap_or_default())
    };
    let shown_robot = args.body.as_ref().map(read).transpose()?;
    let file = args.file.iter().map(|recording| recording.path.clone());
    let inputs = file.chain(args.source.as_ref().and_then(SourceSpec::file));
    let named = [&args.body, &args.robot].into_iter().flatten().map(PathBuf::from).chain(args.folds.clone());
    let lists = shown_robot.iter().flat_map(ShownRobot::lists).map(Path::to_path_buf);
    let output = Output::stream(&args.output, args.force, inputs.chain(named).chain(lists))?;
    let seen = match (&args.file, args.source) {
        (Some(recording), _) => {
            let folding = args.folds.as_ref().map(|folds| Folding::recorded(folds, recording)).transpose()?;
            recorded(recording, args.seconds, shown_robot, folding)?
        }
        (None, Some(spec)) => watched(spec, args.seconds, shown_robot, args.folds)?,
        (None, None) => bail!(Fault::usage("give a recording, or a --source")),
    };
    let is_file = !output.is_standard();
    output.write(page(&seen)?.as_bytes())?;
    if is_file {
        println!("{}: figures of {}", args.output.display(), seen.label);
    }
    if !seen.skipped.is_none() {
        eprintln!("{}: {}", seen.label, seen.skipped);
    }
    Ok(())
}

/// Reads a recording.
fn recorded(
    recording: &BoardRecording,
    seconds: Option<f64>,
    shown_robot: Option<ShownRobot>,
    folding: Option<Folding>,
) -> Result<Seen> {
    let mut play = Play::open(recording)?;
    let mut progress = Progress::of(format!("reading {recording}"), Unit::Bytes, Some(play.passed()[1]));
    let mut seen = Seen::new(recording.to_string()).on(shown_robot).folding(folding);
    let mut began = None;
    let mut stamp = Stamp::recorded(0, 0);
    while let Some((header, event)) = play.next_event()? {
        stamp = Stamp::recorded(header.log_time, header.publish_time);
        seen.event(play.client(), &event, stamp)?;
        if let Event::Frame { time, .. } = event {
            progress.at(play.passed()[0]);
            let passed = time.since(*began.get_or_insert(time)) as f64 / 1e6;
            if seconds.is_some_and(|seconds| passed >= seconds) {
                break;
            }
        }
    }
    seen.ended(play.client(), stamp)?;
    seen.skipped = play.skipped();
    Ok(seen)
}

/// Watches a board.
fn watched(
    spec: SourceSpec,
    seconds: Option<f64>,
    shown_robot: Option<ShownRobot>,
    folds: Option<PathBuf>,
) -> Result<Seen> {
    let folding = folds.as_deref().map(Folding::read).transpose()?;
    let options = SourceOptions { seconds, folds, ..SourceOptions::default() };
    let source = source::open(&spec, &options)?;
    let seconds = seconds.or(source.real_time.then_some(WATCHED));
    let mut seen = Seen::new(source.label.clone()).on(shown_robot).folding(folding);
    watch::watch(&WatchOptions { seconds, ..WatchOptions::of(spec) }, source, &mut seen)?;
    Ok(seen)
}
