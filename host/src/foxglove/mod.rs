//! `taxel foxglove`: what a board tells, live in Foxglove and whatever else speaks its WebSocket protocol.
//!
//! The channels are those of a recording, with their schemas (see [`record`](crate::record)). The server only tells: nothing can be asked
//! of the board. It listens on this machine alone, and lets in pages of any site, as Foxglove's own does: Foxglove may be one.
//! A client that reads too slowly misses messages, and is told so; it never slows the board's stream.

mod hub;
mod protocol;
mod publisher;
mod server;
mod subscriber;

pub use hub::Hub;
pub use protocol::channel;
pub use publisher::Publisher;
pub use server::serve;

use crate::live::{self, LiveArgs};
use crate::source::{self, SourceOptions, SourceSpec};
use anyhow::{Context, Result};
use clap::Args;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;

/// Arguments of `taxel foxglove`.
#[derive(Debug, Clone, Args)]
pub struct FoxgloveArgs {
    /// `auto`, `usb`, `sim[:SCENE]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `emulator[:SCENE]` or `replay:FILE[@SPEED]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// Port on this machine: Foxglove looks for 8765; 0: any that is free
    #[arg(long, value_name = "N", default_value_t = 8765)]
    pub port: u16,
    /// Garment that a real or emulated board is to wear: a preset or a TOML file
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// Scene that the board is used for: a TOML file
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Take the mean of the first N frames as the baseline [default: as a simulated scene asks, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096))]
    pub tare: Option<u16>,
}

/// Runs the command.
pub fn run(args: FoxgloveArgs) -> Result<()> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, args.port)).with_context(|| {
        format!("port {} of this machine cannot be used: --port takes another", args.port)
    })?;
    let options = SourceOptions { realtime: true, repeat: true, ..SourceOptions::default() };
    let source = source::open(&args.source, &options)?;
    let hub = Arc::new(Hub::default());
    let port = serve(listener, hub.clone(), &source.label)?;
    println!("{} at ws://127.0.0.1:{port} (Ctrl-C ends)", source.label);
    let live =
        LiveArgs { garment: args.garment, scene: args.scene, tare: args.tare, ..LiveArgs::of(args.source) };
    live::watch(&live, source, &mut Publisher::new(hub))?;
    println!("Nothing more comes; what came last is kept for who comes later (Ctrl-C ends).");
    loop {
        std::thread::park();
    }
}
