//! Opens the source of a command: at once, or once its board is there.

use super::{BoardArgs, stop};
use crate::fault;
use anyhow::Result;
use std::thread;
use std::time::Duration;
use taxel::error::{ErrorKind, SourceError};
use taxel::files::calibrate::Calibration;
use taxel::robot::BoardConfig;
use taxel::source::{Source, SourceOptions, SourceSpec};
use taxel::text::words;

/// Time between two attempts to open a board that is waited for.
const TRY: Duration = Duration::from_secs(1);
/// Exit status of an error of the board.
const BOARD: u8 = 3;

impl BoardArgs {
    /// Opens the source, and reads the calibration if there is one; the source then uses its counts per newton.
    pub fn open(&self, options: SourceOptions) -> Result<(Source, Option<Calibration>)> {
        let options = SourceOptions { seed: self.seed, ..options };
        let (board, mut reported) = (self.read()?, false);
        loop {
            let error = match board.open_any(&options) {
                Ok(source) => return Ok((source, board.calibration)),
                Err(error) => anyhow::Error::from(error),
            };
            if !self.wait || fault::status(&error) != BOARD {
                return Err(error);
            }
            if !std::mem::replace(&mut reported, true) {
                eprintln!("{}; waiting for it (Ctrl-C ends)", words::sentence(error.as_ref()));
            }
            stop::check()?;
            thread::sleep(TRY);
        }
    }

    /// Opens the source for a command that only shows it: of several boards the first, reported with the others, unless
    /// options configure the board.
    /// With `or_simulated`, a simulated board is played, and reported as that, if no source was named and no board is
    /// plugged in; a board that is there and cannot be used is an error.
    pub fn open_to_show(
        &self,
        options: SourceOptions,
        or_simulated: bool,
    ) -> Result<(Source, Option<Calibration>)> {
        let options = SourceOptions {
            first: self.configures().is_none() && self.config.calibration.is_none(),
            ..options
        };
        let opened = match self.open(options.clone()) {
            Err(error) if or_simulated && self.named().is_none() && is_absent(&error) => {
                let simulation = SourceSpec::simulation();
                eprintln!("playing {simulation}, a simulated board: {}", words::sentence(error.as_ref()));
                let config = BoardConfig { source: Some(simulation), ..self.config.clone() };
                BoardArgs { config, ..self.clone() }.open(options)
            }
            opened => opened,
        }?;
        if let (source, [_, ..]) = (&opened.0, opened.0.others.as_slice()) {
            eprintln!("{} is shown; other boards are plugged in: {}", source.label, source.others.join(", "));
        }
        Ok(opened)
    }
}

/// True if no board is plugged in.
fn is_absent(error: &anyhow::Error) -> bool {
    let kind = error.downcast_ref::<taxel::Error>().map(taxel::Error::kind);
    matches!(kind, Some(ErrorKind::Source(SourceError::NoBoard(_))))
}
