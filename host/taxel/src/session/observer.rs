//! Receivers of a board's stream.

use super::posing::{JointPositions, Posing};
use crate::client::{Client, Event, Stamp};
use crate::error::Result;
use crate::source::Source;
use crate::source::array::OriginalBytes;
use std::ops::DerefMut;

/// Receives the stream of one board, in the thread that follows it: shows it, records it, passes it on. An error ends
/// the stream; [`Error::other`](crate::Error::other) holds one of the receiver's own.
///
/// A list of observers is one, too: each gets everything, in the order of the list.
pub trait Observer {
    /// The board's source is open; everything else follows.
    fn opened(&mut self, _source: &Source) -> Result<()> {
        Ok(())
    }

    /// Handles an event and its times; the client already includes it.
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()>;

    /// Handles bytes that are about to be sent to the board.
    fn sent(&mut self, _client: &Client, _bytes: &[u8], _stamp: Stamp) -> Result<()> {
        Ok(())
    }

    /// Handles the bytes of an array in which the stream was perceived.
    fn original(&mut self, _client: &Client, _bytes: &OriginalBytes, _stamp: Stamp) -> Result<()> {
        Ok(())
    }

    /// Called before poses of a robot are sent: hands over positions of joints that come with the receiver's own
    /// messages.
    fn pose(&mut self, _client: &Client, _posing: &mut Posing) -> Result<()> {
        Ok(())
    }

    /// Handles positions of joints that were taken, wherever they came from; the stamp is that of their reading.
    fn joints(&mut self, _client: &Client, _joints: &JointPositions, _stamp: Stamp) -> Result<()> {
        Ok(())
    }

    /// Called after bytes were handled, or after a while without any, also while the board is lost: may queue requests.
    fn idle(&mut self, _client: &mut Client) -> Result<()> {
        Ok(())
    }

    /// Called once at the end of the stream, also of one that an error ends.
    fn ended(&mut self, _client: &Client, _stamp: Stamp) -> Result<()> {
        Ok(())
    }

    /// True once it wants no more: the stream ends.
    fn is_done(&self) -> bool {
        false
    }

    /// True if it goes on with another board in place of the one that it was opened for, after an
    /// [`Event::Other`]. Else the stream ends: what is recorded or written is of one board.
    fn follows_another(&self) -> bool {
        false
    }
}

impl<O: DerefMut<Target: Observer>> Observer for Vec<O> {
    fn opened(&mut self, source: &Source) -> Result<()> {
        self.iter_mut().try_for_each(|one| one.opened(source))
    }

    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        self.iter_mut().try_for_each(|one| one.event(client, event, stamp))
    }

    fn sent(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<()> {
        self.iter_mut().try_for_each(|one| one.sent(client, bytes, stamp))
    }

    fn original(&mut self, client: &Client, bytes: &OriginalBytes, stamp: Stamp) -> Result<()> {
        self.iter_mut().try_for_each(|one| one.original(client, bytes, stamp))
    }

    fn pose(&mut self, client: &Client, posing: &mut Posing) -> Result<()> {
        self.iter_mut().try_for_each(|one| one.pose(client, posing))
    }

    fn joints(&mut self, client: &Client, joints: &JointPositions, stamp: Stamp) -> Result<()> {
        self.iter_mut().try_for_each(|one| one.joints(client, joints, stamp))
    }

    fn idle(&mut self, client: &mut Client) -> Result<()> {
        self.iter_mut().try_for_each(|one| one.idle(client))
    }

    /// All end, even if one fails.
    fn ended(&mut self, client: &Client, stamp: Stamp) -> Result<()> {
        self.iter_mut().map(|one| one.ended(client, stamp)).fold(Ok(()), Result::and)
    }

    fn is_done(&self) -> bool {
        self.iter().any(|one| one.is_done())
    }

    fn follows_another(&self) -> bool {
        self.iter().all(|one| one.follows_another())
    }
}
