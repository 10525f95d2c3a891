//! `taxel robot record`: all boards in one recording.

use super::args::RobotFileArgs;
use super::live::{failed, limit};
use crate::watch::{Overwrite, seconds, stop};
use anyhow::{Error, Result};
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;
use taxel::robot::{BoardEvent, RecordTeller, RobotRecorder, RobotSession, WhenFull};
use taxel::source::SourceOptions;

/// Longest wait before the file is flushed.
const LOOK: Duration = Duration::from_millis(100);

/// Arguments of `taxel robot record`.
#[derive(Debug, Clone, Args)]
pub struct RobotRecordArgs {
    /// The robot.
    #[command(flatten)]
    robot: RobotFileArgs,
    /// File to write (.mcap)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Stop after S seconds of each board's time; a board that is missing is then waited for 10 s [default: a
    /// simulated scene is played once; boards are recorded until Ctrl-C]
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    seconds: Option<f64>,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    force: Overwrite,
    /// Pace simulations to real time
    #[arg(long)]
    realtime: bool,
}

/// Runs the command. Error if a board cannot be followed, once all are over: the others are recorded.
pub fn run(args: &RobotRecordArgs) -> Result<()> {
    let robot = args.robot.read()?;
    let mut requests = args.robot.requests()?;
    stop::catch()?;
    let mut recorder = RobotRecorder::create(&robot, &args.output, args.force.into())?;
    let options =
        SourceOptions { realtime: args.realtime, seconds: args.seconds, ..SourceOptions::default() };
    let plans =
        robot.plans(&options, limit(args.seconds), |number| Box::new(RecordTeller::new(&robot, number)));
    let mut session = RobotSession::start(plans, WhenFull::Wait)?;
    let mut ended = Ok(());
    let mut written = Ok(());
    while written.is_ok() && !session.is_over() && !stop::asked() {
        written = recorder.keep();
        requests.iter_mut().for_each(|requests| requests.ask(&session, None));
        let Some(event) = session.wait(LOOK) else { continue };
        let name = &robot.boards[event.board].name;
        match &event.what {
            BoardEvent::News(record) => {
                record.refusal.iter().for_each(|why| eprintln!("board {name}: {why}"));
                written = written.and_then(|()| recorder.take(event.board, record));
            }
            // A recording may not be looked at for days.
            BoardEvent::Absent { why } => eprintln!("board {name} is not there: {why}; waiting for it"),
            BoardEvent::Lost { why, .. } | BoardEvent::Other { why } => eprintln!("board {name}: {why}"),
            BoardEvent::Back { after } => {
                eprintln!("board {name} is back after {:.1} s", after.as_secs_f64());
            }
            _ => {}
        }
        if let BoardEvent::Lost { .. } = event.what {
            written = written.and_then(|()| recorder.lost(event.board, event.stamp.host_us));
        }
        ended = ended.and(failed(name, event.what));
    }
    drop(session);
    // The recording is completed even if a board fails.
    written = written.and(recorder.finish());
    eprint!("{}", recorder.summary());
    written.map_err(Error::from).and(ended)
}
