//! A board that is followed for the page, and the messages to it.

use super::lines::{alone, real};
use super::serial::SerialPipe;
use anyhow::{Context, Result};
use serde::Deserialize;
use std::sync::Arc;
use taxel::robot::Following;
use taxel::session::Returns;
use taxel::source::{self, Source, SourceOptions, SourceSpec};
use taxel_cli::on_robot::ShownRobot;
use taxel_cli::view::lines::EndLine;
use taxel_cli::view::{Mailbox, PageHub, Parcel, Viewer, message};

/// Body and robot of the garment that is played where nothing was named.
const REFERENCE: &str = "reference";

/// Board that the page asks for.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Opening {
    /// Script that its simulation plays; none to wait for hands on the reference garment.
    pub script: Option<String>,
    /// Name of the serial port that the page has opened; none for a simulation.
    pub serial: Option<String>,
}

/// A board, what follows it, and the page's messages.
pub struct Worker {
    hub: Arc<PageHub>,
    page: Arc<Mailbox>,
    viewer: Viewer,
    board: Option<Following>,
    serial: SerialPipe,
}

impl Worker {
    /// Opens a board. Error if there is no such script, or too many pages.
    pub fn open(opening: Opening) -> Result<Worker> {
        let hub = Arc::new(PageHub::default());
        let page = hub.join().context("too many pages are open")?;
        let mut viewer = Viewer::new(hub.clone(), None);
        let serial = SerialPipe::default();
        let source = match opening {
            Opening { serial: Some(name), .. } => real(&name, serial.clone()),
            Opening { script: Some(script), .. } => simulated(SourceSpec::Sim(script), false)?,
            _ => {
                hub.show_robot(ShownRobot::read(REFERENCE, Some(REFERENCE), "")?);
                simulated(SourceSpec::simulation(), true)?
            }
        };
        let board = Following::open(alone(source, Returns::Always), &mut viewer)?;
        Ok(Worker { hub, page, viewer, board: Some(board), serial })
    }

    /// Handles what has come from the board since. Returns true if there may be more at once.
    pub fn turn(&mut self) -> bool {
        let Some(board) = &mut self.board else { return false };
        let why = match board.turn(&mut self.viewer) {
            Ok(true) => return board.bytes() > 0,
            Ok(false) => None,
            Err(error) => Some(format!("{:#}", anyhow::Error::from(error))),
        };
        let ended = self.board.take().map(|board| board.end(&mut self.viewer));
        let why = why.or_else(|| ended?.err().map(|error| error.to_string()));
        why.into_iter().for_each(|text| self.hub.state("end", &EndLine { text }));
        false
    }

    /// Handles a request of the page.
    pub fn ask(&self, text: &str) {
        message::request(text).into_iter().for_each(|request| self.hub.request(&self.page, request));
    }

    /// Takes the next message to the page that is due.
    pub fn next(&self) -> Option<Parcel> {
        self.page.due()
    }

    /// A file that the page saves: the last half minute, or what was pressed.
    pub fn file(&self, name: &str) -> Result<Vec<u8>> {
        match name {
            "recording.mcap" => {
                let mut file = Vec::new();
                self.hub.save(&mut file)?;
                Ok(file)
            }
            _ => Ok(self.hub.touches().context("nothing was pressed")??.into_bytes()),
        }
    }

    /// The serial port, for the page.
    pub fn serial(&self) -> &SerialPipe {
        &self.serial
    }
}

/// A simulated board in real time, whose script is repeated.
fn simulated(spec: SourceSpec, waits: bool) -> Result<Source> {
    let options = SourceOptions { realtime: true, repeat: true, waits, ..SourceOptions::default() };
    Ok(source::open(&spec, &options)?)
}
