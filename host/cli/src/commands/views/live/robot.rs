//! `taxel live` of a robot: all boards as lines of text or JSON.

use super::LiveArgs;
use super::lines::{BoardNews, JsonLines, TextLines};
use crate::fault::Fault;
use crate::watch::{RequestLines, RobotNews, RobotObserver, run_limit, watch_robot};
use anyhow::{Result, bail};
use std::io::{BufWriter, Stdout, Write, stdout};
use taxel::mind::{MindReader, RobotMeaning, RobotMeaningLine, RobotMind};
use taxel::robot::{
    BoardEvent, BoardLine, BoardQueue, BoardState, ReadRobot, RobotEvent, RobotStream, WhenFull,
};
use taxel::session::Observer;
use taxel::source::SourceOptions;
use taxel::text::words;

/// Prefix of lines about the whole robot.
const ROBOT: &str = "robot";

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &LiveArgs, robot: &ReadRobot) -> Result<()> {
    if args.taxel.is_some() {
        let file = &robot.file;
        bail!(Fault::usage(format!(
            "--taxel is for a board, {file} is a robot's file: name one, {file}#BOARD"
        )));
    }
    let requests = RequestLines::of(args.board.requests.as_deref())?;
    let options = SourceOptions {
        seed: args.board.seed,
        realtime: args.realtime,
        frames: args.frames,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let is_minded = robot.is_at_one_time(args.realtime);
    let mind = is_minded.then(|| RobotMind::new(robot)).transpose()?;
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
    let session = RobotStream::start(plans, WhenFull::DropImages, observer)?;
    let mut lines = RobotLines { robot, mind, json: args.json, wide, out: BufWriter::new(stdout()) };
    let ended = watch_robot(robot, session, requests, &mut lines);
    lines.out.flush()?;
    ended
}

/// Prints what all boards say, and what that means.
struct RobotLines<'a> {
    robot: &'a ReadRobot,
    /// None if boards are not at one time.
    mind: Option<RobotMind>,
    json: bool,
    /// Characters of the longest name.
    wide: usize,
    out: BufWriter<Stdout>,
}

impl RobotObserver<BoardNews> for RobotLines<'_> {
    fn mind(&mut self) -> Option<&mut RobotMind> {
        self.mind.as_mut()
    }

    fn event(&mut self, news: RobotNews<'_, BoardNews>) -> Result<()> {
        let RobotNews { session, inputs, event } = news;
        for meaning in inputs.iter().filter_map(|input| input.news.as_ref()) {
            self.write_meaning(meaning)?;
        }
        event.map_or(Ok(()), |event| self.write(event))?;
        let meaning = self.mind.as_mut().and_then(|mind| match event {
            Some(event) => mind.event(event, |news| news.sense.as_ref()),
            None => mind.pass(session.now_us()),
        });
        meaning.cloned().map_or(Ok(()), |meaning| self.write_meaning(&meaning))?;
        // Nothing has come for a moment.
        if event.is_none() {
            self.out.flush()?;
        }
        Ok(())
    }
}

impl RobotLines<'_> {
    /// Writes what a board says.
    fn write(&mut self, event: &RobotEvent<BoardNews>) -> Result<()> {
        let (name, wide) = (&self.robot.boards[event.board].name, self.wide);
        match &event.what {
            BoardEvent::News(news) => write!(self.out, "{}", news.lines)?,
            BoardEvent::State(state) if self.json => {
                let line = BoardLine::of(name, event.stamp.host_us, state);
                writeln!(self.out, "{}", serde_json::to_string(&line)?)?;
            }
            BoardEvent::State(state) => {
                said(state).map_or(Ok(()), |said| writeln!(self.out, "{name:wide$} {said}"))?;
            }
        }
        Ok(())
    }

    /// Writes what touches mean.
    fn write_meaning(&mut self, meaning: &RobotMeaning) -> Result<()> {
        let (Some(mind), wide) = (&self.mind, self.wide) else { return Ok(()) };
        let line = RobotMeaningLine::of(mind, meaning);
        match self.json {
            true => writeln!(self.out, "{}", serde_json::to_string(&line)?)?,
            false => writeln!(self.out, "{ROBOT:wide$} {}", line.text())?,
        }
        Ok(())
    }
}

/// Returns how a board is, in words; none if its lines say it: it is met, lost, back, over.
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
