//! `taxel record` of a robot: all boards in one recording.

use super::live::{failed, limit};
use super::requests::{RequestLines, Told};
use super::view::pages;
use super::viewed::ViewedTeller;
use crate::commands::recordings::record::RecordArgs;
use crate::commands::views::view::{announce, bind};
use crate::fault::Fault;
use crate::view::RobotPages;
use crate::watch::stop;
use anyhow::{Error, Result, bail};
use std::thread;
use std::time::Duration;
use taxel::mind::{MindRecord, MindRecordTeller, RecordedMind, RobotMind};
use taxel::robot::{BoardEvent, ReadRobot, RobotEvent, RobotRecorder, RobotSession, Teller, WhenFull};
use taxel::source::SourceOptions;

/// Longest wait before the file is flushed.
const LOOK: Duration = Duration::from_millis(100);
/// Time in which a board's bytes gather: pages show them so much later.
const GATHER: Duration = Duration::from_millis(40);
/// Time in which events gather once all are taken: of many boards, each would wake this thread.
const REST: Duration = Duration::from_millis(5);

/// What becomes of a robot's events.
struct Recording<'a> {
    recorder: RobotRecorder,
    /// None if boards are not at one time.
    mind: Option<RecordedMind>,
    /// None without a view.
    pages: Option<RobotPages<'a>>,
}

/// Runs the command. Error if a board cannot be followed, once all are over: the others are recorded.
pub fn run(args: &RecordArgs, robot: &ReadRobot) -> Result<()> {
    let of_one =
        [("--frames", args.frames.is_some()), ("--rotate", args.rotate.is_some()), ("--ros2", args.ros2)];
    if let Some((option, _)) = of_one.into_iter().find(|(_, is_there)| *is_there) {
        let file = &robot.file;
        bail!(Fault::usage(format!(
            "{option} is for a board, {file} is a robot's file: name one, {file}#BOARD"
        )));
    }
    let mut requests = RequestLines::of(args.board.requests.as_deref())?;
    let is_minded = robot.is_at_one_time(args.realtime);
    let mind = is_minded.then(|| RobotMind::new(robot)).transpose()?;
    let view = args.view.then(|| anyhow::Ok((bind(args.port)?, pages(robot)?))).transpose()?;
    stop::catch()?;
    let mut recorder = RobotRecorder::create(robot, &args.output, args.force.into())?;
    let mind = mind.map(|mind| RecordedMind::begin(mind, &mut recorder)).transpose()?;
    let pages = view.map(|(port, pages)| {
        announce(&format!("robot {}", robot.name), port, pages.hubs(), args.open).map(|()| pages)
    });
    let mut recording = Recording { recorder, mind, pages: pages.transpose()? };
    let options = SourceOptions {
        seed: args.board.seed,
        realtime: args.realtime,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let mut plans = robot.plans(&options, limit(args.seconds), |number| -> Box<dyn Teller<MindRecord>> {
        let records = recording.recorder.teller(number);
        let records = MindRecordTeller::new(robot, number, records);
        match &recording.pages {
            Some(pages) => Box::new(ViewedTeller::new(robot, number, records, pages.hub(number))),
            None => Box::new(records),
        }
    });
    plans.iter_mut().for_each(|plan| plan.gather = GATHER);
    let mut session = RobotSession::start(plans, WhenFull::Wait)?;
    let mut ended = Ok(());
    let mut written = Ok(());
    while written.is_ok() && !session.is_over() && !stop::asked() {
        let hears = recording.mind.as_mut().map(RecordedMind::mind);
        let told = requests.as_mut().map_or(Vec::new(), |requests| requests.ask(&session, hears));
        let event = session.wait(Duration::ZERO).or_else(|| {
            thread::sleep(REST);
            session.wait(LOOK)
        });
        written = recording.take(event.as_ref(), &told, session.now_us());
        let Some(event) = event else { continue };
        let name = &robot.boards[event.board].name;
        say(name, &event.what);
        ended = ended.and(failed(name, event.what));
    }
    drop(session);
    // The recording is completed even if a board fails.
    let Recording { mut recorder, .. } = recording;
    written = written.and(recorder.finish());
    eprint!("{}", recorder.summary());
    written.map_err(Error::from).and(ended)
}

impl Recording<'_> {
    /// Writes and shows an event of a board, or that the time passes, and what the mind was told before.
    fn take(
        &mut self,
        event: Option<&RobotEvent<MindRecord>>,
        told: &[Told],
        now_us: u64,
    ) -> taxel::Result<()> {
        self.recorder.keep()?;
        if let Some(RobotEvent { board, what: BoardEvent::News(news), .. }) = event {
            self.recorder.take(*board, &news.record)?;
        }
        if let Some(mind) = &mut self.mind {
            write_mind(&mut self.recorder, mind, told, event, now_us)?;
        }
        let Some(pages) = &mut self.pages else { return Ok(()) };
        told.iter().for_each(|told| pages.told(&told.line));
        if let Some(event) = event {
            pages.event(event, |news| news.sense.as_ref());
        }
        pages.turn(self.mind.as_mut().map(|mind| &*mind.mind()));
        Ok(())
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
