//! Passes a board's stream to the clients.

use super::hub::FoxgloveHub;
use super::protocol;
use super::subscriber::ChannelMessage;
use std::sync::Arc;
use taxel::Result;
use taxel::client::{Client, Event, Stamp};
use taxel::record;
use taxel::session::Observer;

/// Topic of images, the only one that is costly to encode; skipped if nobody subscribes.
const LARGE: &str = "frames";

/// Sends everything to the clients of a hub.
#[derive(Debug)]
pub struct Publisher {
    hub: Arc<FoxgloveHub>,
}

impl Publisher {
    /// One that sends to these.
    pub fn new(hub: Arc<FoxgloveHub>) -> Publisher {
        Publisher { hub }
    }
}

impl Observer for Publisher {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
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
