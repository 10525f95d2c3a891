//! `taxel reset-settings`: restarts a board with the shipped settings, and keeps its saved ones aside.

use crate::fault::Fault;
use crate::watch::{self, WatchOptions};
use anyhow::{Result, bail};
use clap::Args;
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, Stamp};
use taxel::session::Observer;
use taxel::source::{self, SourceOptions, SourceSpec};
use taxel_core::wire::Request;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel reset-settings
  taxel reset-settings --source usb --undo";

/// Start the board with the shipped settings; keep the saved ones aside
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ResetSettingsArgs {
    /// The board: `auto`, `usb[:SERIAL]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD`, `sim[:TOUCHES]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// Use the settings that were kept aside
    #[arg(long)]
    pub undo: bool,
}

/// Longest wait for the answer.
const PATIENCE: Duration = Duration::from_secs(20);
/// Request number in the answer to an unreadable request.
const UNREADABLE: u8 = 255;

/// Runs the command.
pub fn run(args: ResetSettingsArgs) -> Result<()> {
    let source = source::open(&args.source, &SourceOptions::default())?;
    let label = source.label.clone();
    let mut asking = Asking { undo: args.undo, begun: Instant::now(), asked: false, done: false };
    watch::watch(&WatchOptions::of(args.source.clone()), source, &mut asking)?;
    if !asking.done {
        bail!(Fault::board(format!("{label} ended before the board had answered")));
    }
    match args.undo {
        true => println!("{label} restarts with its saved settings."),
        false => println!(
            "{label} restarts with the shipped settings. Saved settings are kept aside until the next `taxel save`; \
             `taxel reset-settings --undo` uses them again."
        ),
    }
    Ok(())
}

/// Sends the request once the board is known, and waits for its answer.
struct Asking {
    undo: bool,
    begun: Instant,
    asked: bool,
    done: bool,
}

impl Observer for Asking {
    fn event(&mut self, _: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        let Event::Answer { request, refusal } = event else { return Ok(()) };
        match refusal {
            None => self.done |= *request == Request::ResetSettings { undo: false }.number(),
            Some(_) if self.asked && *request == UNREADABLE => {
                let why = "the board's firmware cannot do this: flash the firmware of this version";
                return Err(Fault::board(why).into());
            }
            Some(why) => return Err(Fault::board(format!("the board refuses: {why}")).into()),
        }
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        if !self.asked && client.description().is_some() {
            client.request(&Request::ResetSettings { undo: self.undo })?;
            self.asked = true;
        }
        if !self.done && self.begun.elapsed() > PATIENCE {
            return Err(Fault::board("the board does not answer").into());
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.done
    }
}
