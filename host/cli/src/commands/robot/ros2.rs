//! `taxel ros2` of a robot: a node for each board, and one for the robot.

use super::live::{failed, limit};
use super::requests::RequestLines;
use super::shown::ShownTeller;
use crate::commands::views::ros2::Ros2Args;
use crate::fault::Fault;
use crate::ros2::{RobotNode, RosNode, RosParameters, RosPlace, RosShow};
use crate::watch::stop;
use anyhow::{Context, Result, ensure};
use std::time::Duration;
use taxel::body;
use taxel::mind::BoardSense;
use taxel::robot::{ReadRobot, RobotSession, Teller, WhenFull};
use taxel::ros2::topic_part;
use taxel::source::Source;

/// Longest wait before Ctrl-C is noticed.
const LOOK: Duration = Duration::from_millis(100);

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &Ros2Args, robot: &ReadRobot) -> Result<()> {
    let place = args.node.place()?;
    check_names(robot)?;
    let mut requests = RequestLines::of(args.board.requests.as_deref())?;
    let options = args.board.at_real_time(args.seconds);
    let image_hz = args.node.image_hz;
    let open = |place: RosPlace, source: String| RosNode::open(place, &RosParameters { source, image_hz });
    let at =
        format!("robot {} as node {} in domain {}", robot.name, place.absolute(&place.name), place.domain);
    let mut node = RobotNode::open(open(place.clone(), robot.file.clone())?, robot)?;
    // One after the other: of nodes that join the network in the same moment, one may stay unknown to others.
    let boards = robot.boards.iter();
    let nodes = boards.map(|board| open(place.of_board(&board.name), board.source.to_string()));
    let mut nodes = nodes.map(|node| node.map(Some)).collect::<Result<Vec<_>>>()?;
    let teller = |number: usize| -> Box<dyn Teller<BoardSense>> {
        let (mut node, body) = (nodes[number].take(), robot.boards[number].body.clone());
        let open = move |source: &Source| shown(node.take(), source, body.as_deref());
        Box::new(ShownTeller::new(robot, number, open))
    };
    let plans = robot.plans(&options, limit(args.seconds), teller);
    // The nodes leave the network before the program ends.
    stop::catch()?;
    let mut session = RobotSession::start(plans, WhenFull::DropImages)?;
    println!("{at} (Ctrl-C ends)");
    let mut ended = Ok(());
    while !session.is_over() && !stop::asked() {
        let told = requests.as_mut().map_or(Vec::new(), |requests| requests.ask(&session, Some(node.mind())));
        told.iter().filter_map(|told| told.news.as_ref()).try_for_each(|meaning| node.mean(meaning))?;
        let event = session.wait(LOOK);
        node.turn(&session, event.is_none())?;
        if let Some(event) = event {
            node.event(&event)?;
            ended = ended.and(failed(&robot.boards[event.board].name, event.what));
        }
    }
    ended
}

/// Offers a board on its node.
fn shown(node: Option<RosNode>, source: &Source, body: Option<&str>) -> Result<RosShow> {
    let body = body.map(body::read).transpose()?;
    RosShow::open(node.context("the node is in use")?, source, false, body)
}

/// Error if two boards have one name in ROS, which knows no `-`.
fn check_names(robot: &ReadRobot) -> Result<()> {
    let names: Vec<String> = robot.boards.iter().map(|board| topic_part(&board.name)).collect();
    for (number, name) in names.iter().enumerate() {
        if let Some(other) = names[..number].iter().position(|other| other == name) {
            let (a, b) = (&robot.boards[other].name, &robot.boards[number].name);
            ensure!(
                false,
                Fault::usage(format!("{}: boards {a} and {b} are both {name} in ROS", robot.file))
            );
        }
    }
    Ok(())
}
