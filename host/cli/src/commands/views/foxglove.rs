//! `taxel foxglove`: serves a board's stream to Foxglove and other programs with its WebSocket protocol.

use crate::foxglove::{FoxgloveHub, Publisher, serve};
use crate::watch::{self, BoardArgs, WatchOptions};
use anyhow::{Context, Result};
use clap::Args;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use taxel::source::SourceOptions;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel foxglove --source sim:pat
  taxel foxglove --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

/// Serve a board's stream to Foxglove, live
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct FoxgloveArgs {
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Port on this machine: Foxglove looks for 8765; 0: any that is free
    #[arg(long, value_name = "N", default_value_t = 8765)]
    pub port: u16,
    /// Also let in pages of this site, `https://viewer.example.org` say [default: Foxglove's, and those of this
    /// machine]
    #[arg(long, value_name = "SITE")]
    pub allow_origin: Vec<String>,
}

/// Runs the command.
pub fn run(args: FoxgloveArgs) -> Result<()> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, args.port)).with_context(|| {
        format!("port {} of this machine cannot be used: choose another with --port", args.port)
    })?;
    let options = SourceOptions { realtime: true, repeat: true, ..SourceOptions::default() };
    let (source, _) = args.board.open(options)?;
    let hub = Arc::new(FoxgloveHub::default());
    let port = serve(listener, hub.clone(), &source.label, &args.allow_origin)?;
    println!("{} at ws://127.0.0.1:{port} (Ctrl-C ends)", source.label);
    watch::watch(&WatchOptions::on(args.board), source, &mut Publisher::new(hub))?;
    println!("Stream ended; new clients get the last messages (Ctrl-C ends).");
    loop {
        std::thread::park();
    }
}
