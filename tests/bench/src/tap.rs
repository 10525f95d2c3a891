//! A simulated board behind TCP whose bytes are kept, and the bytes of a recording, for `tests/zenoh`.

use anyhow::{Context, Result};
use clap::Args;
use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use taxel::recording::{BoardRecording, LinkRecord, WireReader};
use taxel::source::{self, SourceOptions, SourceSpec};

/// Arguments of a board behind TCP.
#[derive(Debug, Clone, Args)]
pub struct TapArgs {
    /// The board
    source: SourceSpec,
    /// Seed of the simulation
    seed: u64,
    /// File for the bytes that it sends
    kept: PathBuf,
}

/// Arguments of the bytes of a recording.
#[derive(Debug, Clone, Args)]
pub struct WireArgs {
    /// The recording
    recording: BoardRecording,
    /// File for its bytes
    kept: PathBuf,
}

/// Prints a port, and passes bytes between whoever connects to it first and the board.
pub fn run(args: &TapArgs) -> Result<()> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).context("no port is free")?;
    println!("port {}", listener.local_addr()?.port());
    let options =
        SourceOptions { seed: Some(args.seed), realtime: true, repeat: true, ..SourceOptions::default() };
    let mut kept = File::create(&args.kept).with_context(|| args.kept.display().to_string())?;
    let (mut link, _) = listener.accept()?;
    let mut board = source::open(&args.source, &options)?.port;
    link.set_nodelay(true)?;
    let mut buffer = [0; 4096];
    loop {
        link.set_nonblocking(true)?;
        match link.read(&mut buffer) {
            Ok(0) => return Ok(()),
            Ok(count) => drop(board.write(&buffer[..count])?),
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(_) => return Ok(()),
        }
        link.set_nonblocking(false)?;
        let Some(count) = board.read(&mut buffer)? else { return Ok(()) };
        kept.write_all(&buffer[..count])?;
        if link.write_all(&buffer[..count]).is_err() {
            return Ok(());
        }
    }
}

/// Writes the bytes of a recording.
pub fn wire(args: &WireArgs) -> Result<()> {
    let mut wire = WireReader::open(&args.recording)?;
    let mut kept = File::create(&args.kept).with_context(|| args.kept.display().to_string())?;
    while let Some((_, record)) = wire.next_record()? {
        if let LinkRecord::Frame(bytes) = record {
            kept.write_all(bytes)?;
        }
    }
    Ok(())
}
