//! `taxel view` of a robot: all boards in the browser.

use super::{ViewArgs, announce, bind};
use crate::fault::Fault;
use crate::on_robot::ShownRobot;
use crate::view::{RobotPages, Viewer};
use crate::watch::{RequestLines, RobotNews, RobotObserver, run_limit, watch_robot};
use anyhow::{Result, bail};
use std::thread;
use std::time::Duration;
use taxel::mind::{BoardSense, MindReader, RobotMind};
use taxel::robot::{ReadRobot, RobotStream, WhenFull};
use taxel::session::Observer;

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &ViewArgs, robot: &ReadRobot) -> Result<()> {
    if args.joints.is_some() {
        bail!(Fault::usage("--joints is for a board: --requests sends a robot's joints"));
    }
    if args.listen {
        bail!(Fault::usage("--listen is for one board: name it, robot.toml#hand"));
    }
    let requests = RequestLines::of(args.board.requests.as_deref())?;
    let mind = RobotMind::new(robot)?;
    let pages = pages(robot)?;
    if args.read_only {
        (0..robot.boards.len()).for_each(|number| pages.hub(number).read_only());
    }
    announce(&format!("robot {}", robot.name), bind(args.port)?, pages.hubs(), args.open)?;
    let options = args.board.at_real_time(args.seconds);
    let plans = robot.plans(&options, &run_limit(None, args.seconds));
    let session = RobotStream::start(plans, WhenFull::DropImages, |number, queue| {
        let mut mind = MindReader::new(robot, number);
        let viewer = Box::new(viewer(&pages, robot, number)) as Box<dyn Observer + Send>;
        Box::new(vec![viewer, queue.make(move |client, event, _| mind.sense(client, event))])
    })?;
    let ended = watch_robot(robot, session, requests, &mut RobotView { mind, pages });
    if args.seconds.is_some() || ended.is_err() {
        return ended;
    }
    println!("Streams ended; showing the last frames (Ctrl-C ends).");
    loop {
        thread::park();
    }
}

/// Shows what all boards say, and what that means, to the pages.
struct RobotView<'a> {
    mind: RobotMind,
    pages: RobotPages<'a>,
}

impl RobotObserver<BoardSense> for RobotView<'_> {
    /// Longest wait before pages get what is new.
    const LOOK: Duration = Duration::from_millis(50);

    fn mind(&mut self) -> Option<&mut RobotMind> {
        Some(&mut self.mind)
    }

    fn event(&mut self, news: RobotNews<'_, BoardSense>) -> Result<()> {
        let RobotNews { session, inputs, event } = news;
        inputs.iter().for_each(|input| self.pages.take_input(&input.line));
        match event {
            Some(event) => {
                self.mind.event(event, |sense| Some(sense));
                self.pages.event(event, |sense| Some(sense));
            }
            None => drop(self.mind.pass(session.now_us())),
        }
        self.pages.turn(Some(&self.mind));
        Ok(())
    }
}

/// The pages of a robot, on which garments with a body are shown on the robot. Error if a body cannot be read.
pub fn pages(robot: &ReadRobot) -> Result<RobotPages<'_>> {
    let pages = RobotPages::new(robot);
    for number in 0..robot.boards.len() {
        shown_robot(robot, number)?
            .into_iter()
            .for_each(|shown_robot| pages.hub(number).show_robot(shown_robot));
    }
    Ok(pages)
}

/// Shows a board to the pages of its hub, which can save it with its calibration.
pub fn viewer(pages: &RobotPages<'_>, robot: &ReadRobot, number: usize) -> Viewer {
    Viewer::new(pages.hub(number), robot.boards[number].calibration.clone())
}

/// The robot that carries the garment of a board; none without a body.
fn shown_robot(robot: &ReadRobot, number: usize) -> Result<Option<ShownRobot>> {
    let urdf = robot.robot.as_ref().map(|described| described.file());
    let body = robot.boards[number].body.as_deref();
    body.map(|body| ShownRobot::read(body, urdf, "")).transpose()
}
