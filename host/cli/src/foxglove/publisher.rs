//! Passes a board's stream to the clients.

use super::hub::FoxgloveHub;
use super::protocol;
use super::subscriber::ChannelMessage;
use anyhow::Result;
use std::sync::Arc;
use taxel::client::{Client, Event};
use taxel::record::{self, Stamps};
use taxel::session::Show;

/// Topic of images, the only one that is costly to encode; skipped if nobody subscribes.
const LARGE: &str = "frames";

/// Sends everything to the clients of a hub.
#[derive(Debug)]
pub struct Publisher {
    hub: Arc<FoxgloveHub>,
    stamps: Stamps,
}

impl Publisher {
    /// Starts now.
    pub fn new(hub: Arc<FoxgloveHub>) -> Publisher {
        Publisher { hub, stamps: Stamps::start() }
    }
}

impl Show<anyhow::Error> for Publisher {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        let stamp = self.stamps.of(client, event);
        let Some((topic, channel)) =
            record::topic(event).and_then(|topic| Some((topic, protocol::channel(topic)?)))
        else {
            return Ok(());
        };
        if topic != LARGE || self.hub.wants(channel) {
            let data = record::json_message(client, event, stamp)?;
            self.hub.tell(ChannelMessage { channel, ns: stamp.host_ns(), data });
        }
        Ok(())
    }
}
