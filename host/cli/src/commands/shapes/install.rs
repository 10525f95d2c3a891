//! `taxel shapes install`: sends a base to a board, which uses it until it is switched off.

use crate::fault::Fault;
use crate::watch::{self, WatchOptions};
use anyhow::{Result, bail};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, Stamp};
use taxel::files::bases::Base;
use taxel::session::Observer;
use taxel::session::setting::set_shapes;
use taxel::source::{self, SourceOptions, SourceSpec};
use taxel_core::wire::Request;

/// Arguments of `taxel shapes install`.
#[derive(Debug, Clone, clap::Args)]
pub struct InstallArgs {
    /// Base: a file, or the name of a shipped base
    pub base: PathBuf,
    /// The board: as in `taxel live`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
}

/// Time limit for everything.
const PATIENCE: Duration = Duration::from_secs(20);

/// Runs the command.
pub fn run(args: InstallArgs) -> Result<()> {
    let base = Base::open(&args.base)?;
    let source = source::open(&args.source, &SourceOptions::default())?;
    let label = source.label.clone();
    let mut installing = Installing { base, opened: Instant::now(), begun: None, installed: None };
    watch::watch(&WatchOptions::of(args.source), source, &mut installing)?;
    match installing.installed {
        Some((classes, prototypes)) => {
            println!("{label} knows {classes} classes by {prototypes} prototypes, until it restarts.");
            Ok(())
        }
        None => bail!(Fault::board(format!("{label} ended before the board had the base"))),
    }
}

/// Waits for the board, sends the base, and waits for its confirmation.
struct Installing {
    base: Base,
    opened: Instant,
    begun: Option<Instant>,
    installed: Option<(usize, u16)>,
}

impl Observer for Installing {
    fn event(&mut self, _: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        match event {
            Event::Answer { request, refusal: Some(why) }
                if [Request::SetShapes(&[]), Request::AddShapes(&[])]
                    .iter()
                    .any(|r| r.number() == *request) =>
            {
                return Err(Fault::board(format!("the board refuses: {why}")).into());
            }
            Event::Shapes { names, prototypes } if self.begun.is_some() && *prototypes > 0 => {
                self.installed = Some((names.len(), *prototypes));
            }
            _ => {}
        }
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        let silent = || Err(Fault::board("the board does not answer").into());
        match self.begun {
            None if client.description().is_some() => {
                let too_long = |error: taxel::Error| error.context("the base is too long for a request");
                set_shapes(client, &self.base).map_err(too_long)?;
                self.begun = Some(Instant::now());
            }
            None if self.opened.elapsed() > PATIENCE => return silent(),
            Some(begun) if begun.elapsed() > PATIENCE => return silent(),
            _ => {}
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.installed.is_some()
    }
}
