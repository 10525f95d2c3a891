//! `taxel serve`: offers a board to other machines over Zenoh.

mod robot;

use crate::watch::{self, BoardArgs, WatchOptions, stop, time};
use anyhow::Result;
use clap::Args;
use std::path::PathBuf;
use taxel::network::{self, BoardPlace, NetworkEnd};
use taxel::offer::BoardOffer;
use taxel::source::SourceOptions;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel serve --source sim:pat --name arm/left
  taxel serve --source usb --name arm/left --zenoh router.json5
  taxel live --source zenoh:arm/left@router.json5";

/// Offer a board to other machines over Zenoh; there it is `--source zenoh:ROBOT/BOARD`
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ServeArgs {
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Name of the robot and of its board: others follow it as zenoh:ROBOT/BOARD
    #[arg(long, value_name = "ROBOT/BOARD", default_value = "robot/board")]
    pub name: BoardPlace,
    /// The network.
    #[command(flatten)]
    pub network: NetworkArgs,
    /// Stop after this time of the board, such as 2s or 10min [default: never; simulated scenes are repeated]
    #[arg(long = "for", value_name = "TIME", value_parser = time, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
}

/// The network in which boards are offered.
#[derive(Debug, Clone, Args)]
pub struct NetworkArgs {
    /// Zenoh's configuration, JSON5: endpoints, TLS, users, access rules [default: the file that ZENOH_CONFIG
    /// names, else this machine alone]
    #[arg(long, value_name = "FILE")]
    pub zenoh: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: ServeArgs) -> Result<()> {
    if let Some(robot) = args.board.robot()? {
        return robot::run(&args, &robot);
    }
    let options = SourceOptions { realtime: true, repeat: true, ..SourceOptions::default() };
    let network = network::open(NetworkEnd::Offer, args.network.zenoh.as_deref())?;
    let mut offer = BoardOffer::open(&network, &args.name)?;
    let (source, _) = args.board.open(options)?;
    // Others learn at once that the board is no longer offered.
    stop::catch()?;
    println!("{} as zenoh:{} (Ctrl-C ends)", source.label, args.name);
    watch::watch(&WatchOptions { seconds: args.seconds, ..WatchOptions::on(args.board) }, source, &mut offer)
}
