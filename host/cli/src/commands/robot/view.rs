//! `taxel view` of a robot: all boards in the browser.

use super::live::{failed, limit};
use super::requests::RequestLines;
use super::shown::ShownTeller;
use crate::commands::views::view::{ViewArgs, announce, bind};
use crate::fault::Fault;
use crate::on_robot::Wearer;
use crate::view::{PageHub, RobotPages, Tape, Viewer};
use anyhow::{Result, bail};
use std::sync::Arc;
use std::thread;
use std::time::Duration;
use taxel::files::calibrate::Calibration;
use taxel::mind::{BoardSense, RobotMind};
use taxel::record::Origin;
use taxel::robot::{ReadRobot, RobotSession, Teller, WhenFull};
use taxel::source::Source;

/// Longest wait before pages are told what is new.
const LOOK: Duration = Duration::from_millis(50);

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &ViewArgs, robot: &ReadRobot) -> Result<()> {
    if args.joints.is_some() {
        bail!(Fault::usage("--joints is for a board: --requests tells a robot's joints"));
    }
    let mut requests = RequestLines::of(args.board.requests.as_deref())?;
    let mut mind = RobotMind::new(robot)?;
    let mut pages = pages(robot)?;
    announce(&format!("robot {}", robot.name), bind(args.port)?, pages.hubs(), args.open)?;
    let options = args.board.at_real_time(args.seconds);
    let teller = |number: usize| -> Box<dyn Teller<BoardSense>> {
        let (hub, calibration) = (pages.hub(number), robot.boards[number].calibration.clone());
        let open = move |source: &Source| Ok(viewer(source, &hub, calibration.clone()));
        Box::new(ShownTeller::new(robot, number, open))
    };
    let plans = robot.plans(&options, limit(args.seconds), teller);
    let mut session = RobotSession::start(plans, WhenFull::DropImages)?;
    let mut ended = Ok(());
    while !session.is_over() {
        let told = requests.as_mut().map_or(Vec::new(), |requests| requests.ask(&session, Some(&mut mind)));
        told.iter().for_each(|told| pages.told(&told.line));
        match session.wait(LOOK) {
            Some(event) => {
                mind.event(&event, |sense| Some(sense));
                pages.event(&event, |sense| Some(sense));
                let name = &robot.boards[event.board].name;
                ended = ended.and(failed(name, event.what));
            }
            None => drop(mind.pass(session.now_us())),
        }
        pages.turn(Some(&mind));
    }
    if args.seconds.is_some() || ended.is_err() {
        return ended;
    }
    println!("Streams ended; showing the last frames (Ctrl-C ends).");
    loop {
        thread::park();
    }
}

/// The pages of a robot, on which garments with a body are shown on the robot. Error if a body cannot be read.
pub fn pages(robot: &ReadRobot) -> Result<RobotPages<'_>> {
    let pages = RobotPages::new(robot);
    for number in 0..robot.boards.len() {
        wearer(robot, number)?.into_iter().for_each(|wearer| pages.hub(number).wear(wearer));
    }
    Ok(pages)
}

/// Shows a board to the pages of its hub, which can save it with its calibration.
pub fn viewer(source: &Source, hub: &Arc<PageHub>, calibration: Option<Calibration>) -> Viewer {
    let (label, counts_per_newton) = (source.label.clone(), source.counts_per_newton);
    hub.tape(Tape::Live(Arc::new(Origin { label, counts_per_newton, calibration })));
    Viewer::new(source, hub.clone())
}

/// The robot that wears the garment of a board; none without a body.
fn wearer(robot: &ReadRobot, number: usize) -> Result<Option<Wearer>> {
    let urdf = robot.robot.as_ref().map(|described| described.file());
    let body = robot.boards[number].body.as_deref();
    body.map(|body| Wearer::read(body, urdf, "")).transpose()
}
