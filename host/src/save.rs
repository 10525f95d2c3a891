//! `taxel save`: what the board knows survives a restart.

use crate::client::{Client, Event};
use crate::live::{self, LiveArgs, Show};
use crate::source::{self, SourceOptions, SourceSpec};
use anyhow::{Result, bail};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use taxel_core::wire::Request;

/// Arguments of `taxel save`.
#[derive(Debug, Clone, clap::Args)]
pub struct SaveArgs {
    /// The board: `auto`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// Garment that it is to wear first: a preset or a TOML file
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// Scene that it is used for: a TOML file; what it does not say is as shipped
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Take the mean of N frames as the baseline first
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096))]
    pub tare: Option<u16>,
}

/// Longest time from a request to its answer.
const PATIENCE: Duration = Duration::from_secs(20);

/// Runs the command.
pub fn run(args: SaveArgs) -> Result<()> {
    let source = source::open(&args.source, &SourceOptions::default())?;
    let label = source.label.clone();
    let tare = args.tare.unwrap_or(0);
    let mut saving = Saving { waits_for: tare > 0, asked: None, done: false };
    let live =
        LiveArgs { garment: args.garment, scene: args.scene, tare: Some(tare), ..LiveArgs::of(args.source) };
    live::watch(&live, source, &mut saving)?;
    if !saving.done {
        bail!("{label} ended before it had stored its settings");
    }
    println!("{label} has stored garment, scene, gains and baseline: they survive a restart.");
    Ok(())
}

/// Waits for what is to be done before, asks for the save, and waits for that.
struct Saving {
    /// A tare is under way.
    waits_for: bool,
    asked: Option<Instant>,
    done: bool,
}

impl Show for Saving {
    fn event(&mut self, _: &Client, event: &Event) -> Result<()> {
        let Event::Answer { request, refusal } = event else { return Ok(()) };
        if let Some(why) = refusal {
            bail!("the board refuses: {why}");
        }
        self.waits_for &= *request != Request::Tare { frames: 0 }.number();
        self.done |= *request == Request::Save.number();
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> Result<bool> {
        match self.asked {
            None if client.worn().is_some() && !self.waits_for => {
                client.request(&Request::Save)?;
                self.asked = Some(Instant::now());
            }
            Some(asked) if asked.elapsed() > PATIENCE => bail!("the board does not answer"),
            _ => {}
        }
        Ok(!self.done)
    }
}
