//! Hands a board of a robot to what shows a board that is watched alone.

use taxel::client::{Client, Event};
use taxel::mind::{BoardHeard, HeardReader};
use taxel::record::Stamp;
use taxel::robot::{ReadRobot, Teller};
use taxel::session::Show;
use taxel::source::Source;
use taxel::{Error, Result};

/// Opens what shows a board, once its source is open.
type Opener<S> = Box<dyn FnMut(&Source) -> anyhow::Result<S> + Send>;

/// Hands the stream to a receiver in the board's thread; the robot gets what it says of touches.
pub struct ShownTeller<S> {
    open: Opener<S>,
    /// None before the source is open.
    shown: Option<Result<S>>,
    reader: HeardReader,
}

impl<S> ShownTeller<S> {
    /// Of a board of a robot.
    pub fn new(
        robot: &ReadRobot,
        number: usize,
        open: impl FnMut(&Source) -> anyhow::Result<S> + Send + 'static,
    ) -> ShownTeller<S> {
        ShownTeller { open: Box::new(open), shown: None, reader: HeardReader::new(robot, number, true) }
    }

    /// The receiver, if it is open. Error if it could not be opened.
    fn show(&mut self) -> Result<Option<&mut S>> {
        match self.shown.take() {
            Some(Err(error)) => Err(error),
            opened => {
                self.shown = opened;
                Ok(self.shown.as_mut().and_then(|shown| shown.as_mut().ok()))
            }
        }
    }
}

impl<S: Show<anyhow::Error> + Send> Teller<BoardHeard> for ShownTeller<S> {
    fn opened(&mut self, source: &Source) {
        self.shown = Some((self.open)(source).map_err(Error::other));
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<Option<BoardHeard>> {
        if let Some(show) = self.show()? {
            client.lines().for_each(|line| show.bytes(line));
            show.event(client, event).map_err(Error::other)?;
        }
        let heard = self.reader.read(client, event);
        Ok((heard.scan.is_some() || heard.sense.is_some()).then_some(heard))
    }

    fn note(&mut self, client: &Client, note: &Event, _: Stamp) -> Result<Option<BoardHeard>> {
        self.show()?.map_or(Ok(()), |show| show.gap(client, note)).map_err(Error::other)?;
        Ok(None)
    }

    fn asked(&mut self, client: &Client, bytes: &[u8], _: Stamp) -> Result<Option<BoardHeard>> {
        self.show()?.map_or(Ok(()), |show| show.asked(client, bytes)).map_err(Error::other)?;
        Ok(None)
    }

    fn idle(&mut self, client: &mut Client) -> Result<()> {
        // Whoever shows a board does not end it.
        self.show()?.map_or(Ok(true), |show| show.idle(client)).map(drop).map_err(Error::other)
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> Result<Option<BoardHeard>> {
        self.show()?.map_or(Ok(()), |show| show.end(client)).map_err(Error::other)?;
        Ok(None)
    }
}
