//! `taxel fcm why` of a robot: explains what touches mean to the robot, down to the contacts of its boards.

use super::WhyArgs;
use crate::watch::{RequestLines, RobotNews, RobotObserver, run_limit, watch_robot};
use anyhow::{Result, bail};
use std::time::Duration;
use taxel::mind::{BoardSense, MindReader, RobotMeaning, RobotMind, RobotReasons};
use taxel::robot::{ReadRobot, RobotStream, WhenFull};
use taxel::source::SourceOptions;
use taxel_core::intent::Leading;

/// Runs the command: simulations are played at real time. Error if no intention is announced.
pub fn run(args: &WhyArgs, robot: &ReadRobot) -> Result<()> {
    let requests = RequestLines::of(args.reported.requests.as_deref())?;
    let options = SourceOptions { realtime: true, ..SourceOptions::default() };
    let plans = robot.plans(&options, &run_limit(None, None));
    let session = RobotStream::start(plans, WhenFull::DropImages, |number, queue| {
        let mut reader = MindReader::new(robot, number);
        queue.make(move |client, event, _| reader.sense(client, event))
    })?;
    let (at, begun_us) = (args.reported.at, session.now_us());
    let mut ear = RobotEar { mind: RobotMind::new(robot)?, at, begun_us, found: None };
    watch_robot(robot, session, requests, &mut ear)?;
    let reasons = match (ear.found, at) {
        (Some(seconds), _) => RobotReasons::of(&ear.mind, seconds, args.of.as_deref(), robot)?,
        (None, None) => {
            bail!("{}: no intention was announced; --at TIME explains the state at that time", robot.file)
        }
        (None, Some(at)) => bail!("{}: its boards were over before {at} s", robot.file),
    };
    match args.json {
        true => println!("{}", reasons.json(robot)),
        false => print!("{}", reasons.text(robot, args.paths)),
    }
    Ok(())
}

/// Follows the boards until the moment that is to be explained.
struct RobotEar {
    mind: RobotMind,
    /// The moment, s since the begin; none: that of the first intention.
    at: Option<f64>,
    begun_us: u64,
    /// Time at which it has come, in seconds since the begin.
    found: Option<f64>,
}

impl RobotObserver<BoardSense> for RobotEar {
    /// Longest wait before the requests are read again.
    const LOOK: Duration = Duration::from_millis(20);

    fn mind(&mut self) -> Option<&mut RobotMind> {
        Some(&mut self.mind)
    }

    fn event(&mut self, news: RobotNews<'_, BoardSense>) -> Result<()> {
        let RobotNews { session, inputs, event } = news;
        let seconds = session.now_us().saturating_sub(self.begun_us) as f64 / 1e6;
        let is_found = |meaning: &RobotMeaning| self.at.is_none() && meaning.leading != Leading::None;
        let mut is_now = inputs.iter().filter_map(|input| input.news.as_ref()).any(is_found)
            || self.at.is_some_and(|at| seconds >= at);
        // What is to be explained stays as it is.
        if let Some(event) = event.filter(|_| !is_now) {
            is_now = self.mind.event(event, |sense| Some(sense)).is_some_and(is_found);
        }
        self.found = is_now.then_some(seconds);
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.found.is_some()
    }
}
