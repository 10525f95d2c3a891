//! `taxel serve` of a robot: offers all boards of a robot to other machines over Zenoh.

use super::live::failed;
use super::requests::RequestLines;
use crate::commands::views::serve::ServeArgs;
use crate::fault::Fault;
use crate::watch::{run_limit, stop};
use anyhow::Result;
use std::time::Duration;
use taxel::network::{self, BoardPlace, NetworkEnd};
use taxel::offer::BoardOffer;
use taxel::robot::{ReadRobot, RobotStream, WhenFull};
use taxel::session::Observer;

/// Longest wait before Ctrl-C is noticed.
const LOOK: Duration = Duration::from_millis(100);

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &ServeArgs, robot: &ReadRobot) -> Result<()> {
    let mut requests = RequestLines::of(args.board.requests.as_deref())?;
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
    let mut session: RobotStream<()> =
        RobotStream::start(plans, WhenFull::DropImages, |_, _| Box::new(Vec::from_iter(offers.next())))?;
    println!("robot {} as zenoh:{0}/BOARD (Ctrl-C ends)", robot.name);
    let mut ended = Ok(());
    while !session.is_over() && !stop::asked() {
        requests.iter_mut().for_each(|requests| drop(requests.ask(&session, None)));
        if let Some(event) = session.wait(LOOK) {
            ended = ended.and(failed(&robot.boards[event.board].name, event.what));
        }
    }
    ended
}
