//! `taxel robot record`: all boards in one recording.

use super::args::RobotFileArgs;
use super::live::{failed, limit};
use super::requests::Told;
use crate::watch::{Overwrite, seconds, stop};
use anyhow::{Error, Result};
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;
use taxel::mind::{MindRecord, MindRecordTeller, RecordedMind, RobotMind};
use taxel::robot::{BoardEvent, RobotEvent, RobotRecorder, RobotSession, WhenFull};
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
    let is_minded = robot.is_at_one_time(args.realtime);
    let mind = is_minded.then(|| RobotMind::new(&robot)).transpose()?;
    stop::catch()?;
    let mut recorder = RobotRecorder::create(&robot, &args.output, args.force.into())?;
    let options =
        SourceOptions { realtime: args.realtime, seconds: args.seconds, ..SourceOptions::default() };
    let mut mind = mind.map(|mind| RecordedMind::begin(mind, &mut recorder)).transpose()?;
    let plans = robot.plans(&options, limit(args.seconds), |number| {
        Box::new(MindRecordTeller::new(&robot, number, is_minded))
    });
    let mut session = RobotSession::start(plans, WhenFull::Wait)?;
    let mut ended = Ok(());
    let mut written = Ok(());
    while written.is_ok() && !session.is_over() && !stop::asked() {
        let hears = mind.as_mut().map(RecordedMind::mind);
        let told = requests.as_mut().map_or(Vec::new(), |requests| requests.ask(&session, hears));
        let event = session.wait(LOOK);
        written = recorder.keep().and_then(|()| match &event {
            Some(event) => write(&mut recorder, event),
            None => Ok(()),
        });
        if let Some(mind) = &mut mind {
            let now_us = session.now_us();
            written = written.and_then(|()| write_mind(&mut recorder, mind, &told, event.as_ref(), now_us));
        }
        let Some(event) = event else { continue };
        let name = &robot.boards[event.board].name;
        say(name, &event.what);
        ended = ended.and(failed(name, event.what));
    }
    drop(session);
    // The recording is completed even if a board fails.
    written = written.and(recorder.finish());
    eprint!("{}", recorder.summary());
    written.map_err(Error::from).and(ended)
}

/// Writes an event of a board.
fn write(recorder: &mut RobotRecorder, event: &RobotEvent<MindRecord>) -> taxel::Result<()> {
    match &event.what {
        BoardEvent::News(news) => recorder.take(event.board, &news.record),
        BoardEvent::Lost { .. } => recorder.lost(event.board, event.stamp.host_us),
        _ => Ok(()),
    }
}

/// Writes what the mind was told, and what an event means to it; without one, that the time passes.
fn write_mind(
    recorder: &mut RobotRecorder,
    mind: &mut RecordedMind,
    told: &[Told],
    event: Option<&RobotEvent<MindRecord>>,
    now_us: u64,
) -> taxel::Result<()> {
    for Told { host_us, line, news } in told {
        mind.told(recorder, line, *host_us, news.as_ref())?;
    }
    match event {
        Some(event) => mind.hear(recorder, event),
        None => mind.pass(recorder, now_us),
    }
}

/// Says how a board is: a recording may not be looked at for days.
fn say(name: &str, what: &BoardEvent<MindRecord>) {
    match what {
        BoardEvent::News(MindRecord { record, .. }) => {
            record.refusal.iter().for_each(|why| eprintln!("board {name}: {why}"));
        }
        BoardEvent::Absent { why } => eprintln!("board {name} is not there: {why}; waiting for it"),
        BoardEvent::Lost { why, .. } | BoardEvent::Other { why } => eprintln!("board {name}: {why}"),
        BoardEvent::Back { after } => eprintln!("board {name} is back after {:.1} s", after.as_secs_f64()),
        _ => {}
    }
}
