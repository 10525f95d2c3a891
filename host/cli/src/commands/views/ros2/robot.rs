//! `taxel ros2` of a robot: a node for each board, and one for the robot.

use super::Ros2Args;
use crate::fault::Fault;
use crate::ros2::{RobotNode, RosNode, RosParameters, RosPlace, RosShow};
use crate::watch::{RequestLines, RobotNews, RobotObserver, run_limit, stop, watch_robot};
use anyhow::{Result, ensure};
use taxel::body;
use taxel::mind::{BoardSense, MindReader, RobotMind};
use taxel::robot::{ReadRobot, RobotStream, WhenFull};
use taxel::ros2::topic_part;
use taxel::session::Observer;

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &Ros2Args, robot: &ReadRobot) -> Result<()> {
    let place = args.node.place()?;
    check_names(robot)?;
    let requests = RequestLines::of(args.board.requests.as_deref())?;
    let options = args.board.at_real_time(args.seconds);
    let image_hz = args.node.image_hz;
    let open = |place: RosPlace, source: String| RosNode::open(place, &RosParameters { source, image_hz });
    let at =
        format!("robot {} as node {} in domain {}", robot.name, place.absolute(&place.name), place.domain);
    let mut node = RobotNode::open(open(place.clone(), robot.file.clone())?, robot)?;
    // One after the other: of nodes that join the network in the same moment, one may stay unknown to others.
    let boards = robot.boards.iter();
    let nodes = boards.map(|board| open(place.of_board(&board.name), board.source.to_string()));
    let shown = nodes.zip(&robot.boards).map(|(node, board)| {
        let body = board.body.as_deref().map(body::read).transpose()?;
        Ok(Box::new(RosShow::new(node?, args.clock, body)) as Box<dyn Observer + Send>)
    });
    let mut shown = shown.collect::<Result<Vec<_>>>()?.into_iter();
    let plans = robot.plans(&options, &run_limit(None, args.seconds));
    // The nodes leave the network before the program ends.
    stop::catch()?;
    let session = RobotStream::start(plans, WhenFull::DropImages, |number, queue| {
        let mut mind = MindReader::new(robot, number);
        let mind = queue.make(move |client, event, _| mind.sense(client, event));
        Box::new(shown.next().into_iter().chain([mind]).collect::<Vec<_>>())
    })?;
    println!("{at} (Ctrl-C ends)");
    watch_robot(robot, session, requests, &mut node)
}

impl RobotObserver<BoardSense> for RobotNode<'_> {
    fn mind(&mut self) -> Option<&mut RobotMind> {
        Some(RobotNode::mind(self))
    }

    fn event(&mut self, news: RobotNews<'_, BoardSense>) -> Result<()> {
        let RobotNews { session, inputs, event } = news;
        inputs.iter().filter_map(|input| input.news.as_ref()).try_for_each(|meaning| self.mean(meaning))?;
        self.turn(session, event.is_none())?;
        event.map_or(Ok(()), |event| RobotNode::event(self, event))?;
        Ok(())
    }
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
