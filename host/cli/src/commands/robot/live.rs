//! `taxel live` of a robot: all boards as lines of text or JSON.

use super::lines::{BoardNews, JsonLines, TextLines};
use super::requests::RequestLines;
use crate::fault::Fault;
use crate::watch::{LiveArgs, run_limit, stop};
use anyhow::{Context, Error, Result, bail};
use std::io::{BufWriter, Write, stdout};
use std::time::Duration;
use taxel::mind::{MindReader, RobotMeaning, RobotMeaningLine, RobotMind};
use taxel::robot::{BoardEvent, BoardLine, BoardQueue, BoardState, ReadRobot, RobotStream, WhenFull};
use taxel::session::Observer;
use taxel::source::SourceOptions;
use taxel::tell::words;

/// Longest wait before the output is flushed.
const LOOK: Duration = Duration::from_millis(100);

/// What precedes lines about the whole robot.
const ROBOT: &str = "robot";

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &LiveArgs, robot: &ReadRobot) -> Result<()> {
    if args.taxel.is_some() {
        let file = &robot.file;
        bail!(Fault::usage(format!(
            "--taxel is for a board, {file} is a robot's file: name one, {file}#BOARD"
        )));
    }
    let mut requests = RequestLines::of(args.board.requests.as_deref())?;
    let options = SourceOptions {
        seed: args.board.seed,
        realtime: args.realtime,
        frames: args.frames,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let is_minded = robot.is_at_one_time(args.realtime);
    let mut mind = is_minded.then(|| RobotMind::new(robot)).transpose()?;
    let names = robot.boards.iter().map(|board| board.name.len());
    let wide = names.chain(is_minded.then_some(ROBOT.len())).max().unwrap_or(0);
    let observer = |number: usize, queue: &BoardQueue<BoardNews>| -> Box<dyn Observer + Send> {
        let (board, mind) = (&robot.boards[number], is_minded.then(|| MindReader::new(robot, number)));
        match args.json {
            true => Box::new(JsonLines::new(board, args.pixels, mind, queue)),
            false => Box::new(TextLines::new(format!("{:wide$} ", board.name), mind, queue)),
        }
    };
    let plans = robot.plans(&options, &run_limit(args.frames, args.seconds));
    let mut session = RobotStream::start(plans, WhenFull::DropImages, observer)?;
    let mut out = BufWriter::new(stdout());
    let mut ended = Ok(());
    while !session.is_over() && !stop::asked() {
        let told = requests.as_mut().map_or(Vec::new(), |requests| requests.ask(&session, mind.as_mut()));
        for (mind, meaning) in told.iter().filter_map(|told| mind.as_ref().zip(told.news.as_ref())) {
            write_meaning(args.json, wide, mind, meaning, &mut out)?;
        }
        let Some(event) = session.wait(LOOK) else {
            let now_us = session.now_us();
            mind.as_mut()
                .map_or(Ok(()), |mind| meant(args.json, wide, mind, &mut out, |mind| mind.pass(now_us)))?;
            out.flush()?;
            continue;
        };
        let name = &robot.boards[event.board].name;
        match &event.what {
            BoardEvent::News(news) => write!(out, "{}", news.lines)?,
            BoardEvent::State(state) if args.json => {
                let line = BoardLine::of(name, event.stamp.host_us, state);
                writeln!(out, "{}", serde_json::to_string(&line)?)?;
            }
            BoardEvent::State(state) => {
                said(state).map_or(Ok(()), |said| writeln!(out, "{name:wide$} {said}"))?;
            }
        }
        if let Some(mind) = &mut mind {
            meant(args.json, wide, mind, &mut out, |mind| mind.event(&event, |news| news.sense.as_ref()))?;
        }
        ended = ended.and(failed(name, event.what));
    }
    out.flush()?;
    ended
}

/// Writes what touches mean now if that is news.
fn meant(
    json: bool,
    wide: usize,
    mind: &mut RobotMind,
    out: &mut impl Write,
    hear: impl FnOnce(&mut RobotMind) -> Option<&RobotMeaning>,
) -> Result<()> {
    let Some(meaning) = hear(mind).cloned() else { return Ok(()) };
    write_meaning(json, wide, mind, &meaning, out)
}

/// Writes what touches mean.
fn write_meaning(
    json: bool,
    wide: usize,
    mind: &RobotMind,
    meaning: &RobotMeaning,
    out: &mut impl Write,
) -> Result<()> {
    let line = RobotMeaningLine::of(mind, meaning);
    match json {
        true => writeln!(out, "{}", serde_json::to_string(&line)?)?,
        false => writeln!(out, "{ROBOT:wide$} {}", line.text())?,
    }
    Ok(())
}

/// How a board is, in words; none if its lines say it: it is met, lost, back, over.
fn said(state: &BoardState) -> Option<String> {
    Some(match state {
        BoardState::Absent { why } => format!("absent: {why}; waiting for it"),
        BoardState::Other { why } => format!("refused: {why}"),
        BoardState::Dropped { images } => format!("{images} images dropped: the reader is too slow"),
        BoardState::Over { remark: Some(remark) } => remark.clone(),
        BoardState::Failed(error) => format!("failed: {}", words::sentence(error)),
        _ => return None,
    })
}

/// The error of a board that cannot be followed any longer.
pub fn failed<T>(name: &str, what: BoardEvent<T>) -> Result<()> {
    match what {
        BoardEvent::State(BoardState::Failed(error)) => {
            Err(Error::from(error)).with_context(|| format!("board {name}"))
        }
        _ => Ok(()),
    }
}
