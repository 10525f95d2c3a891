//! Receivers of a session's stream.

use super::posing::{JointPositions, Posing};
use crate::client::{Client, Event};
use crate::error::{Error, Result};

/// Receiver of a stream: shows or stores it. `E` is the error of the program that drives it; receivers of
/// this library take any that is made from an [`Error`].
pub trait Show<E = Error> {
    /// Handles an event; the client already includes it.
    fn event(&mut self, client: &Client, event: &Event) -> Result<(), E>;

    /// True if it goes on with another board in place of the one that it was opened for, after an
    /// [`Event::Other`]. Else the stream ends: what is recorded or written is of one board.
    fn follows_another(&self) -> bool {
        false
    }

    /// True if it tells [remarks](Event::remark) itself. Else the program that drives it prints them.
    fn tells_remarks(&self) -> bool {
        false
    }

    /// Called before these bytes are sent to the board.
    fn asked(&mut self, _client: &Client, _bytes: &[u8]) -> Result<(), E> {
        Ok(())
    }

    /// Called before poses of a robot are sent: hands over positions of joints that come with the receiver's
    /// own messages.
    fn pose(&mut self, _client: &Client, _posing: &mut Posing) -> Result<(), E> {
        Ok(())
    }

    /// Handles positions of joints that were taken, wherever they came from.
    fn joints(&mut self, _client: &Client, _joints: &JointPositions) -> Result<(), E> {
        Ok(())
    }

    /// Called after bytes were handled, or after a while without any. Returns false to stop.
    fn idle(&mut self, _client: &mut Client) -> Result<bool, E> {
        Ok(true)
    }

    /// Called once at the end of the stream.
    fn end(&mut self, _client: &Client) -> Result<(), E> {
        Ok(())
    }
}
