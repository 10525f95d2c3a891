//! Passes a board's stream to the clients.

use super::hub::FoxgloveHub;
use super::protocol;
use super::subscriber::ChannelMessage;
use std::sync::Arc;
use taxel::Result;
use taxel::client::{Client, Event, ImageNews, Stamp};
use taxel::record;
use taxel::session::Observer;

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
        let ns = stamp.host_ns();
        if let Some(channel) = record::topic(event).and_then(protocol::channel) {
            let data = record::json_message(client, event, stamp)?;
            self.hub.send(ChannelMessage { channel, ns, data });
        }
        // Images are long: not unless somebody wants them.
        if matches!(event, Event::Frame { image: ImageNews::Whole, .. }) && self.hub.wants(protocol::IMAGES) {
            let mut data = Vec::new();
            record::append_image(client, stamp, &mut data);
            self.hub.send(ChannelMessage { channel: protocol::IMAGES, ns, data });
        }
        Ok(())
    }
}
