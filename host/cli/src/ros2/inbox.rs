//! Messages and calls that have come: a turn takes a few of them, so that the board's stream goes on during a flood.

use ros2_client::{Message, RmwRequestId, Server, Subscription};
use serde::de::DeserializeOwned;
use std::iter;

/// Most messages of a topic, and most calls of a service, that are taken at a time. The middleware keeps the newest
/// 64 that wait.
const MOST: usize = 32;

/// Takes messages of a topic, oldest first. One that cannot be read is another program's mistake: those behind it
/// are taken the next time.
pub fn received<T>(topic: &Subscription<T>) -> impl Iterator<Item = T>
where
    T: DeserializeOwned + 'static,
{
    iter::from_fn(|| topic.take().ok().flatten()).take(MOST).map(|(message, _)| message)
}

/// Takes calls of a service, oldest first, like [`received`].
pub fn calls<A, B>(service: &Server<A, B>) -> impl Iterator<Item = (RmwRequestId, A)>
where
    A: Message + 'static,
    B: Message + 'static,
{
    iter::from_fn(|| service.receive_request().ok().flatten()).take(MOST)
}
