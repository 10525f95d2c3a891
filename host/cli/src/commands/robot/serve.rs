//! `taxel robot serve`: offers all boards of a robot to other machines over Zenoh.

use super::args::RobotFileArgs;
use super::live::{failed, limit};
use super::shown::ShownTeller;
use crate::commands::views::serve::NetworkArgs;
use crate::fault::Fault;
use crate::watch::{seconds, stop};
use anyhow::{Context, Result};
use clap::Args;
use std::time::Duration;
use taxel::mind::BoardSense;
use taxel::network::{self, BoardPlace, NetworkEnd};
use taxel::offer::BoardOffer;
use taxel::robot::{RobotSession, Teller, WhenFull};
use taxel::source::{Source, SourceOptions};

/// Longest wait before Ctrl-C is noticed.
const LOOK: Duration = Duration::from_millis(100);

/// Arguments of `taxel robot serve`.
#[derive(Debug, Clone, Args)]
pub struct RobotServeArgs {
    /// The robot.
    #[command(flatten)]
    robot: RobotFileArgs,
    /// The network.
    #[command(flatten)]
    network: NetworkArgs,
    /// Stop after S seconds of each board's time; a board that is missing is then waited for 10 s [default:
    /// never; simulated scenes are repeated]
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    seconds: Option<f64>,
}

/// Runs the command. Error if a board cannot be followed, once all are over.
pub fn run(args: &RobotServeArgs) -> Result<()> {
    let robot = args.robot.read()?;
    let mut requests = args.robot.requests()?;
    let places = robot.boards.iter().map(|board| BoardPlace::new(&robot.name, &board.name));
    let places: Result<Vec<_>, _> = places.collect();
    let places = places.map_err(|why| Fault::usage(format!("{}: {why}", robot.file)))?;
    let network = network::open(NetworkEnd::Offer, args.network.zenoh.as_deref())?;
    let offers: Result<Vec<_>, _> =
        places.iter().map(|place| BoardOffer::open(&network, place).map(Some)).collect();
    let mut offers = offers?;
    let options =
        SourceOptions { realtime: true, repeat: true, seconds: args.seconds, ..SourceOptions::default() };
    let teller = |number: usize| -> Box<dyn Teller<BoardSense>> {
        let mut offer = offers[number].take();
        let open = move |_: &Source| offer.take().context("the board is offered already");
        Box::new(ShownTeller::new(&robot, number, open))
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
