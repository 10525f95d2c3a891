//! Hands a board of a robot to what shows a board that is watched alone.

use taxel::client::{Client, Event};
use taxel::mind::{BoardSense, MindReader};
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
    mind: MindReader,
}

impl<S> ShownTeller<S> {
    /// Of a board of a robot.
    pub fn new(
        robot: &ReadRobot,
        number: usize,
        open: impl FnMut(&Source) -> anyhow::Result<S> + Send + 'static,
    ) -> ShownTeller<S> {
        ShownTeller { open: Box::new(open), shown: None, mind: MindReader::new(robot, number) }
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

impl<S: Show<anyhow::Error> + Send> Teller<BoardSense> for ShownTeller<S> {
    fn opened(&mut self, source: &Source) {
        self.shown = Some((self.open)(source).map_err(Error::other));
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<Option<BoardSense>> {
        if let Some(show) = self.show()? {
            show.event(client, event).map_err(Error::other)?;
        }
        Ok(self.mind.sense(client, event))
    }

    fn asked(&mut self, client: &Client, bytes: &[u8], _: Stamp) -> Result<Option<BoardSense>> {
        self.show()?.map_or(Ok(()), |show| show.asked(client, bytes)).map_err(Error::other)?;
        Ok(None)
    }

    fn idle(&mut self, client: &mut Client) -> Result<()> {
        // Whoever shows a board does not end it.
        self.show()?.map_or(Ok(true), |show| show.idle(client)).map(drop).map_err(Error::other)
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> Result<Option<BoardSense>> {
        self.show()?.map_or(Ok(()), |show| show.end(client)).map_err(Error::other)?;
        Ok(None)
    }
}
