//! Between the board's one thread and those of the clients.

use super::protocol::{Channel, Wish};
use super::subscriber::{Subscriber, Told};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Clients at a time.
const CLIENTS: usize = 16;

/// What all threads know.
#[derive(Debug, Default)]
pub struct Hub {
    shared: Mutex<Shared>,
}

#[derive(Debug, Default)]
struct Shared {
    clients: Vec<Arc<Subscriber>>,
    /// The last message of each channel, for who comes later.
    known: BTreeMap<Channel, Arc<Told>>,
}

impl Hub {
    /// A thread that panicked leaves everything as it was.
    fn lock(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A new client; none: there are too many.
    pub fn join(&self) -> Option<Arc<Subscriber>> {
        let mut shared = self.lock();
        let client = Arc::new(Subscriber::default());
        (shared.clients.len() < CLIENTS).then(|| shared.clients.push(client.clone()))?;
        Some(client)
    }

    /// A client has gone.
    pub fn leave(&self, client: &Arc<Subscriber>) {
        client.close();
        self.lock().clients.retain(|other| !Arc::ptr_eq(other, client));
    }

    /// Whether some client wants a channel.
    pub fn wants(&self, channel: Channel) -> bool {
        self.lock().clients.iter().any(|client| client.wants(channel))
    }

    /// Does what a client wants.
    pub fn wish(&self, client: &Subscriber, wish: Wish) {
        let shared = self.lock();
        match wish {
            Wish::Subscribe(all) => all
                .into_iter()
                .for_each(|(id, channel)| client.subscribe(id, channel, shared.known.get(&channel))),
            Wish::Unsubscribe(ids) => ids.into_iter().for_each(|id| client.unsubscribe(id)),
        }
    }

    /// Tells all who want to know.
    pub fn tell(&self, told: Told) {
        let told = Arc::new(told);
        let mut shared = self.lock();
        shared.clients.iter().for_each(|client| client.tell(&told));
        shared.known.insert(told.channel, told);
    }
}
