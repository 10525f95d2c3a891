//! Connects the board's thread with those of the clients.

use super::protocol::{Channel, ClientRequest};
use super::subscriber::{ChannelMessage, Subscriber};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Most clients at a time.
const CLIENTS: usize = 16;

/// State shared by all threads.
#[derive(Debug, Default)]
pub struct FoxgloveHub {
    shared: Mutex<FoxgloveShared>,
}

#[derive(Debug, Default)]
struct FoxgloveShared {
    clients: Vec<Arc<Subscriber>>,
    /// Last message of each channel, for later clients.
    known: BTreeMap<Channel, Arc<ChannelMessage>>,
}

impl FoxgloveHub {
    /// Locks the state. A panic of another thread does not invalidate it.
    fn lock(&self) -> MutexGuard<'_, FoxgloveShared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a client; none if there are too many.
    pub fn join(&self) -> Option<Arc<Subscriber>> {
        let mut shared = self.lock();
        let client = Arc::new(Subscriber::default());
        (shared.clients.len() < CLIENTS).then(|| shared.clients.push(client.clone()))?;
        Some(client)
    }

    /// Removes a client.
    pub fn leave(&self, client: &Arc<Subscriber>) {
        client.close();
        self.lock().clients.retain(|other| !Arc::ptr_eq(other, client));
    }

    /// True if a client subscribes to the channel.
    pub fn wants(&self, channel: Channel) -> bool {
        self.lock().clients.iter().any(|client| client.wants(channel))
    }

    /// Handles a client's request.
    pub fn request(&self, client: &Subscriber, request: ClientRequest) {
        let shared = self.lock();
        match request {
            ClientRequest::Subscribe(all) => all
                .into_iter()
                .for_each(|(id, channel)| client.subscribe(id, channel, shared.known.get(&channel))),
            ClientRequest::Unsubscribe(ids) => ids.into_iter().for_each(|id| client.unsubscribe(id)),
        }
    }

    /// Sends a message to all subscribers.
    pub fn send(&self, message: ChannelMessage) {
        let message = Arc::new(message);
        let mut shared = self.lock();
        shared.clients.iter().for_each(|client| client.send(&message));
        shared.known.insert(message.channel, message);
    }
}
