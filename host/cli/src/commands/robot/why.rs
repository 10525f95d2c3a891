//! `taxel fcm why` of a robot: explains what touches mean to the robot, down to the contacts of its boards.

use super::live::failed;
use super::requests::RequestLines;
use crate::commands::maps::why::WhyArgs;
use crate::watch::{run_limit, stop};
use anyhow::{Result, bail};
use std::time::Duration;
use taxel::mind::{MindReader, RobotMeaning, RobotMind, RobotReasons};
use taxel::robot::{ReadRobot, RobotStream, WhenFull};
use taxel::source::SourceOptions;
use taxel_core::intent::Leading;

/// Longest wait before the requests are read again.
const LOOK: Duration = Duration::from_millis(20);

/// Runs the command: simulations are played at real time. Error if no intention is announced.
pub fn run(args: &WhyArgs, robot: &ReadRobot) -> Result<()> {
    let mind = RobotMind::new(robot)?;
    let (mind, seconds) = listen(args, robot, mind)?;
    let reasons = RobotReasons::of(&mind, seconds, args.of.as_deref(), robot)?;
    match args.json {
        true => println!("{}", reasons.json(robot)),
        false => print!("{}", reasons.text(robot, args.paths)),
    }
    Ok(())
}

/// Follows the boards until the moment that is to be explained. Returns the mind then, and the time since the
/// begin, s.
fn listen(args: &WhyArgs, robot: &ReadRobot, mut mind: RobotMind) -> Result<(RobotMind, f64)> {
    let mut requests = RequestLines::of(args.told.requests.as_deref())?;
    let options = SourceOptions { realtime: true, ..SourceOptions::default() };
    let plans = robot.plans(&options, &run_limit(None, None));
    let mut session = RobotStream::start(plans, WhenFull::DropImages, |number, queue| {
        let mut reader = MindReader::new(robot, number);
        queue.make(move |client, event, _| reader.sense(client, event))
    })?;
    let begun_us = session.now_us();
    let since = |now_us: u64| now_us.saturating_sub(begun_us) as f64 / 1e6;
    let is_found = |meaning: &RobotMeaning| args.told.at.is_none() && meaning.leading != Leading::None;
    while !session.is_over() && !stop::asked() {
        let told = requests.as_mut().map_or(Vec::new(), |requests| requests.ask(&session, Some(&mut mind)));
        let now_us = session.now_us();
        if told.iter().filter_map(|told| told.news.as_ref()).any(is_found) {
            return Ok((mind, since(now_us)));
        }
        if args.told.at.is_some_and(|at| since(now_us) >= at) {
            return Ok((mind, since(now_us)));
        }
        let Some(event) = session.wait(LOOK) else { continue };
        if mind.event(&event, |sense| Some(sense)).is_some_and(is_found) {
            return Ok((mind, since(now_us)));
        }
        failed(&robot.boards[event.board].name, event.what)?;
    }
    match args.told.at {
        None => bail!("{}: no intention was announced; --at S explains the state at that time", robot.file),
        Some(at) => bail!("{}: its boards were over before {at} s", robot.file),
    }
}
