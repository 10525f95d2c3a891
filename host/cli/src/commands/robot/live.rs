//! `taxel robot live`: all boards as lines of text or JSON.

use super::args::RobotFileArgs;
use super::tellers::{BoardNews, JsonTeller, TextTeller};
use crate::watch::{seconds, stop};
use anyhow::{Context, Error, Result};
use clap::Args;
use std::io::{BufWriter, Write, stdout};
use std::time::Duration;
use taxel::robot::{BoardEvent, BoardLine, RobotContacts, RobotContactsLine, RobotSession, Teller, WhenFull};
use taxel::source::SourceOptions;
use taxel::tell::words;

/// Longest wait before the output is flushed.
const LOOK: Duration = Duration::from_millis(100);

/// Arguments of `taxel robot live`.
#[derive(Debug, Clone, Args)]
pub struct RobotLiveArgs {
    /// The robot.
    #[command(flatten)]
    robot: RobotFileArgs,
    /// Stop after S seconds of each board's time; a board that is missing is then waited for 10 s [default: a
    /// simulated scene is played once]
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    seconds: Option<f64>,
    /// Print messages as JSON, one per line, each with its `board`
    #[arg(long)]
    json: bool,
    /// With --json: also print the pressure of every taxel
    #[arg(long, requires = "json")]
    pixels: bool,
    /// Pace simulations to real time
    #[arg(long)]
    realtime: bool,
}

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &RobotLiveArgs) -> Result<()> {
    let robot = args.robot.read()?;
    let mut requests = args.robot.requests()?;
    let options =
        SourceOptions { realtime: args.realtime, seconds: args.seconds, ..SourceOptions::default() };
    let wide = robot.boards.iter().map(|board| board.name.len()).max().unwrap_or(0);
    let teller = |number: usize| -> Box<dyn Teller<BoardNews>> {
        let name = &robot.boards[number].name;
        match args.json {
            true => Box::new(JsonTeller::new(&robot, number, args.pixels)),
            false => Box::new(TextTeller::new(format!("{name:wide$} "))),
        }
    };
    let plans = robot.plans(&options, limit(args.seconds), teller);
    let mut session = RobotSession::start(plans, WhenFull::DropImages)?;
    let mut out = BufWriter::new(stdout());
    let mut contacts = (args.json && !robot.seams.is_empty()).then(|| RobotContacts::new(&robot));
    let mut ended = Ok(());
    while !session.is_over() && !stop::asked() {
        requests.iter_mut().for_each(|requests| requests.ask(&session));
        let Some(event) = session.wait(LOOK) else {
            out.flush()?;
            continue;
        };
        let name = &robot.boards[event.board].name;
        match (BoardLine::of(name, event.stamp.host_us, &event.what), &event.what) {
            (_, BoardEvent::News(news)) => write!(out, "{}", news.lines)?,
            (Some(line), _) if args.json => writeln!(out, "{}", serde_json::to_string(&line)?)?,
            (_, what) => said(what).map_or(Ok(()), |said| writeln!(out, "{name:wide$} {said}"))?,
        }
        let host_us = event.stamp.host_us;
        let joined = contacts.as_mut().map(|contacts| match &event.what {
            BoardEvent::News(BoardNews { scan: Some(scan), .. }) => contacts.scan(event.board, scan, host_us),
            BoardEvent::Lost { .. } | BoardEvent::Over | BoardEvent::Failed(_) => {
                contacts.forget(event.board, host_us)
            }
            _ => Vec::new(),
        });
        if let Some(joined) = joined.filter(|joined| !joined.is_empty()) {
            let line = RobotContactsLine::of(&robot, host_us, &joined);
            writeln!(out, "{}", serde_json::to_string(&line)?)?;
        }
        ended = ended.and(failed(name, event.what));
    }
    out.flush()?;
    ended
}

/// How a board is, in words; none if its lines say it: it is met, lost, back, over.
fn said(what: &BoardEvent<BoardNews>) -> Option<String> {
    Some(match what {
        BoardEvent::Absent { why } => format!("absent: {why}; waiting for it"),
        BoardEvent::Other { why } => format!("refused: {why}"),
        BoardEvent::Dropped { images } => format!("{images} images dropped: the reader is too slow"),
        BoardEvent::Failed(error) => format!("failed: {}", words::sentence(error)),
        _ => return None,
    })
}

/// The error of a board that cannot be followed any longer.
pub fn failed<T>(name: &str, what: BoardEvent<T>) -> Result<()> {
    match what {
        BoardEvent::Failed(error) => Err(Error::from(error)).with_context(|| format!("board {name}")),
        _ => Ok(()),
    }
}

/// A time of the command line that limits a stream.
pub fn limit(seconds: Option<f64>) -> Option<Duration> {
    // A time that is too long for a `Duration` is none.
    seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
}
