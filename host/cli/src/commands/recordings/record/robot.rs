//! `taxel record` of a robot: all boards in one recording.

use super::RecordArgs;
use crate::commands::views::view::{announce, bind, pages, viewer};
use crate::view::RobotPages;
use crate::watch::{
    HostInput, Remarks, RequestLines, RobotNews, RobotObserver, run_limit, stop, watch_robot,
};
use anyhow::Result;
use std::thread;
use std::time::Duration;
use taxel::mind::{BoardSense, MindReader, RecordedMind, RobotMind};
use taxel::record::{Plan, Recorder};
use taxel::robot::{BoardEvent, BoardState, ReadRobot, RobotEvent, RobotStream, WhenFull};
use taxel::session::Observer;
use taxel::source::SourceOptions;

/// Time in which a board's bytes gather: pages show them so much later.
const GATHER: Duration = Duration::from_millis(40);
/// Time in which events gather once all are taken: of many boards, each would wake this thread.
const REST: Duration = Duration::from_millis(5);

/// Recording of the events of all boards; those of each are recorded in its thread.
struct Recording<'a> {
    recorder: Recorder,
    /// None if boards are not at one time.
    mind: Option<RecordedMind>,
    /// None without a view.
    pages: Option<RobotPages<'a>>,
    /// Names of the boards.
    names: Vec<&'a str>,
}

/// Runs the command. Error if a board cannot be followed, once all are over: the others are recorded.
pub fn run(args: &RecordArgs, robot: &ReadRobot) -> Result<()> {
    let requests = RequestLines::of(args.board.requests.as_deref())?;
    let is_minded = robot.is_at_one_time(args.realtime);
    let mind = is_minded.then(|| RobotMind::new(robot)).transpose()?;
    let view = args.view.then(|| anyhow::Ok((bind(args.port)?, pages(robot)?))).transpose()?;
    stop::catch()?;
    let recorder = Recorder::create(Plan {
        rotate: args.rotate,
        ros2: args.ros2,
        force: args.force.force,
        ..robot.recording(args.output.clone())?
    })?;
    let mind = mind.map(|mind| RecordedMind::begin(mind, &recorder)).transpose()?;
    let pages = view.map(|(port, pages)| {
        announce(&format!("robot {}", robot.name), port, pages.hubs(), args.open).map(|()| pages)
    });
    let mut recording = Recording {
        recorder,
        mind,
        pages: pages.transpose()?,
        names: robot.boards.iter().map(|board| board.name.as_str()).collect(),
    };
    let options = SourceOptions {
        seed: args.board.seed,
        realtime: args.realtime,
        frames: args.frames,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let mut plans = robot.plans(&options, &run_limit(args.frames, args.seconds));
    plans.iter_mut().for_each(|plan| plan.gather = GATHER);
    let session = RobotStream::start(plans, WhenFull::Wait, |number, queue| {
        let mut mind = MindReader::new(robot, number);
        let mut all: Vec<Box<dyn Observer + Send>> = Vec::new();
        if let Some(pages) = &recording.pages {
            all.push(Box::new(viewer(pages, robot, number).beside_recording()));
        }
        all.push(Box::new(recording.recorder.board(number)));
        all.push(Box::new(Remarks::of(&robot.boards[number].name)));
        all.push(queue.make(move |client, event, _| mind.sense(client, event)));
        Box::new(all)
    })?;
    let ended = watch_robot(robot, session, requests, &mut recording);
    // The recording is completed even if a board fails.
    let written = recording.recorder.finish();
    eprintln!("{}", recording.recorder.summary());
    ended.and(written.map_err(Into::into))
}

impl RobotObserver<BoardSense> for Recording<'_> {
    fn mind(&mut self) -> Option<&mut RobotMind> {
        self.mind.as_mut().map(RecordedMind::mind)
    }

    fn wait(&mut self, session: &mut RobotStream<BoardSense>) -> Option<RobotEvent<BoardSense>> {
        session.wait(Duration::ZERO).or_else(|| {
            thread::sleep(REST);
            session.wait(Self::LOOK)
        })
    }

    fn event(&mut self, news: RobotNews<'_, BoardSense>) -> Result<()> {
        let RobotNews { session, inputs, event } = news;
        if let Some(mind) = &mut self.mind {
            write_mind(&self.recorder, mind, inputs, event, session.now_us())?;
        }
        if let Some(pages) = &mut self.pages {
            inputs.iter().for_each(|input| pages.take_input(&input.line));
            event.into_iter().for_each(|event| pages.event(event, |sense| Some(sense)));
            pages.turn(self.mind.as_mut().map(|mind| &*mind.mind()));
        }
        event.into_iter().for_each(|event| say(self.names[event.board], &event.what));
        Ok(())
    }
}

/// Writes what the mind was given, and what an event means to it; without one, that the time passes.
fn write_mind(
    recorder: &Recorder,
    mind: &mut RecordedMind,
    inputs: &[HostInput],
    event: Option<&RobotEvent<BoardSense>>,
    now_us: u64,
) -> taxel::Result<()> {
    for HostInput { host_us, line, news } in inputs {
        mind.take_input(recorder, line, *host_us, news.as_ref())?;
    }
    match event {
        Some(event) => mind.hear(recorder, event),
        None => mind.pass(recorder, now_us),
    }
}

/// Says how a board is where its remarks do not: a recording may not be looked at for days.
fn say(name: &str, what: &BoardEvent<BoardSense>) {
    match what {
        BoardEvent::State(BoardState::Absent { why }) => {
            eprintln!("board {name} is not there: {why}; waiting for it");
        }
        BoardEvent::State(BoardState::Other { why } | BoardState::Over { remark: Some(why) }) => {
            eprintln!("board {name}: {why}");
        }
        _ => {}
    }
}
