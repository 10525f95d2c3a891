//! `taxel serve` of a robot: offers all boards of a robot to other machines over Zenoh.

use super::ServeArgs;
use crate::fault::Fault;
use crate::watch::{RequestLines, RobotNews, RobotObserver, run_limit, stop, watch_robot};
use anyhow::Result;
use taxel::network::{self, BoardPlace, NetworkEnd};
use taxel::offer::BoardOffer;
use taxel::robot::{ReadRobot, RobotStream, WhenFull};
use taxel::session::Observer;

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &ServeArgs, robot: &ReadRobot) -> Result<()> {
    let requests = RequestLines::of(args.board.requests.as_deref())?;
    let places = robot.boards.iter().map(|board| BoardPlace::new(&robot.name, &board.name));
    let places: Result<Vec<_>, _> = places.collect();
    let places = places.map_err(|why| Fault::usage(format!("{}: {why}", robot.file)))?;
    let network = network::open(NetworkEnd::Offer, args.network.zenoh.as_deref())?;
    let offers = places
        .iter()
        .map(|place| Ok(Box::new(BoardOffer::open(&network, place)?) as Box<dyn Observer + Send>));
    let mut offers = offers.collect::<Result<Vec<_>>>()?.into_iter();
    let options = args.board.at_real_time(args.seconds);
    let plans = robot.plans(&options, &run_limit(None, args.seconds));
    // Others learn at once that the boards are no longer offered.
    stop::catch()?;
    let session: RobotStream<()> =
        RobotStream::start(plans, WhenFull::DropImages, |_, _| Box::new(Vec::from_iter(offers.next())))?;
    println!("robot {} as zenoh:{0}/BOARD (Ctrl-C ends)", robot.name);
    watch_robot(robot, session, requests, &mut Unheard)
}

/// Hears nothing: what the boards say goes into the network.
struct Unheard;

impl RobotObserver<()> for Unheard {
    fn event(&mut self, _: RobotNews<'_, ()>) -> Result<()> {
        Ok(())
    }
}
