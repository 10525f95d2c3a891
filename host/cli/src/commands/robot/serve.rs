//! `taxel serve` of a robot: offers all boards of a robot to other machines over Zenoh.

use super::live::{failed, limit};
use super::requests::RequestLines;
use super::shown::ShownTeller;
use crate::commands::views::serve::ServeArgs;
use crate::fault::Fault;
use crate::watch::stop;
use anyhow::{Context, Result};
use std::time::Duration;
use taxel::mind::BoardSense;
use taxel::network::{self, BoardPlace, NetworkEnd};
use taxel::offer::BoardOffer;
use taxel::robot::{ReadRobot, RobotSession, Teller, WhenFull};
use taxel::source::Source;

/// Longest wait before Ctrl-C is noticed.
const LOOK: Duration = Duration::from_millis(100);

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &ServeArgs, robot: &ReadRobot) -> Result<()> {
    let mut requests = RequestLines::of(args.board.requests.as_deref())?;
    let places = robot.boards.iter().map(|board| BoardPlace::new(&robot.name, &board.name));
    let places: Result<Vec<_>, _> = places.collect();
    let places = places.map_err(|why| Fault::usage(format!("{}: {why}", robot.file)))?;
    let network = network::open(NetworkEnd::Offer, args.network.zenoh.as_deref())?;
    let offers: Result<Vec<_>, _> =
        places.iter().map(|place| BoardOffer::open(&network, place).map(Some)).collect();
    let mut offers = offers?;
    let options = args.board.at_real_time(args.seconds);
    let teller = |number: usize| -> Box<dyn Teller<BoardSense>> {
        let mut offer = offers[number].take();
        let open = move |_: &Source| offer.take().context("the board is offered already");
        Box::new(ShownTeller::new(robot, number, open))
    };
    let plans = robot.plans(&options, limit(args.seconds), teller);
    // Others learn at once that the boards are no longer offered.
    stop::catch()?;
    let mut session = RobotSession::start(plans, WhenFull::DropImages)?;
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
