//! `taxel save`: saves a board's settings to its flash.

use crate::fault::Fault;
use crate::watch::{self, BoardArgs, WatchOptions};
use anyhow::{Result, bail};
use std::time::{Duration, Instant};
use taxel::client::{BoardDescription, Client, Event, Stamp};
use taxel::session::Observer;
use taxel::source::SourceOptions;
use taxel_core::wire::Request;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel save
  taxel save --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

/// Save settings to the board's flash
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct SaveArgs {
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
}

/// Longest wait for an answer.
const PATIENCE: Duration = Duration::from_secs(20);

/// Runs the command.
pub fn run(args: SaveArgs) -> Result<()> {
    let (source, _) = args.board.open(SourceOptions::default())?;
    let label = source.label.clone();
    let tare = args.board.config.tare.unwrap_or(source.tare);
    let mut saving =
        Saving { waits_for: tare > 0, begun: Instant::now(), asked: None, done: false, simulated: false };
    watch::watch(&WatchOptions::on(args.board), source, &mut saving)?;
    if !saving.done {
        bail!(Fault::board(format!("{label} ended before the board had saved its settings")));
    }
    match saving.simulated {
        true => println!("{label} is simulated: what it has saved is gone once it ends, nothing lasts."),
        false => println!("{label} has saved garment, scene, gains and baseline to its flash."),
    }
    Ok(())
}

/// Waits until earlier requests are done, requests the save, and waits for its answer.
struct Saving {
    /// A tare is under way.
    waits_for: bool,
    begun: Instant,
    asked: Option<Instant>,
    done: bool,
    simulated: bool,
}

impl Observer for Saving {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        self.simulated = client.description().is_some_and(BoardDescription::is_simulated);
        let Event::Answer { request, refusal } = event else { return Ok(()) };
        if let Some(why) = refusal {
            return Err(Fault::board(format!("the board refuses: {why}")).into());
        }
        self.waits_for &= *request != Request::Tare { frames: 0 }.number();
        self.done |= *request == Request::Save.number();
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        let silent = || Err(Fault::board("the board does not answer").into());
        match self.asked {
            None if client.description().is_some() && !self.waits_for => {
                client.request(&Request::Save)?;
                self.asked = Some(Instant::now());
            }
            // A tare over many frames may take longer.
            None if client.description().is_none() && self.begun.elapsed() > PATIENCE => return silent(),
            Some(asked) if asked.elapsed() > PATIENCE => return silent(),
            _ => {}
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.done
    }
}
