//! `taxel live`: shows a board's stream in the terminal, as lines of text or as JSON.

mod args;
mod asked;
mod feed;
mod forms;
mod lines;
mod map;
mod messages;
pub(crate) mod narrate;
mod outfit;
mod panes;
pub(crate) mod ramp;
pub(crate) mod rate;
mod screen;
mod svg;
mod taxel;
mod view;
mod watch;

pub use args::{BoardArgs, LiveArgs, seconds};
pub use feed::feed;
pub use forms::forms;
pub use lines::Lines;
pub use messages::{Messages, message};
pub use outfit::GestureModel;
pub use svg::picture;
pub use taxel::{TaxelLines, TaxelPlace};
pub use view::View;
pub use watch::watch;

use crate::client::{Client, Event};
use crate::output::Output;
use crate::source::SourceOptions;
use anyhow::Result;
use std::io::{IsTerminal, stdout};

/// Receiver of a stream: shows or stores it.
pub trait Show {
    /// Handles received bytes; their events follow in [`event`](Show::event).
    fn bytes(&mut self, _bytes: &[u8]) {}

    /// Handles an event; the client already includes it.
    fn event(&mut self, client: &Client, event: &Event) -> Result<()>;

    /// Handles an [`Event::Log`] of the host itself: the source is lost, or is back.
    fn gap(&mut self, client: &Client, note: &Event) -> Result<()> {
        self.event(client, note)
    }

    /// Called before these bytes are sent to the board.
    fn asked(&mut self, _client: &Client, _bytes: &[u8]) -> Result<()> {
        Ok(())
    }

    /// Called after bytes were handled, or after a while without any. Returns false to stop.
    fn idle(&mut self, _client: &mut Client) -> Result<bool> {
        Ok(true)
    }

    /// Called once at the end of the stream.
    fn end(&mut self, _client: &Client) -> Result<()> {
        Ok(())
    }
}

/// Runs the command.
pub fn run(args: LiveArgs) -> Result<()> {
    let terminal = stdout().is_terminal() && !args.json && args.taxel.is_none() && args.svg.is_none();
    let bounded = args.frames.is_some() || args.seconds.is_some();
    let options = SourceOptions {
        realtime: args.realtime || terminal,
        repeat: terminal && !bounded,
        frames: args.frames,
        seconds: args.seconds,
        raw: args.taxel.is_some(),
        ..SourceOptions::default()
    };
    let (source, calibration) = args.board.open(options)?;
    let out = std::io::BufWriter::new(stdout());
    let mut show: Box<dyn Show> = if let Some(file) = &args.svg {
        let inputs = args.board.files().into_iter().chain(args.save.clone());
        Box::new(svg::Painter::new(View::new(&source), Output::stream(file, args.force, inputs)?))
    } else if let Some(place) = &args.taxel {
        Box::new(TaxelLines::new(place.clone(), args.json, out))
    } else if args.json {
        Box::new(Messages::new(args.pixels, out).calibrated(calibration))
    } else if terminal {
        Box::new(screen::Screen::open(View::new(&source))?)
    } else {
        Box::new(Lines::new(&source, out))
    };
    watch(&args, source, show.as_mut())
}
