//! An event as it leaves the client, complete, so that it is independent of what the client takes next.

use crate::array::{Panels, panels};
use serde_json::Value;
use std::io::{self, Empty};
use taxel::client::{Client, Event, ImageNews};
use taxel::json::MessagePrinter;

/// An event.
#[derive(Clone)]
pub struct Fact {
    /// JSON line.
    pub line: Value,
    /// The host's time, ns since 1970.
    pub host_ns: u64,
    /// The image of a frame, or the codes of a scan, by taxel; none if they could not be decoded.
    pub values: Option<Vec<u16>>,
    /// The garment's panels.
    pub panels: Panels,
}

impl Fact {
    /// A line at a time of the host, without an image.
    pub fn alone(line: Value, host_ns: u64) -> Fact {
        Fact { line, host_ns, values: None, panels: Panels::from([]) }
    }
}

/// Reads facts from a client's events.
pub struct FactReader {
    panels: Panels,
    messages: MessagePrinter<Empty>,
}

impl Default for FactReader {
    fn default() -> FactReader {
        FactReader { panels: Panels::from([]), messages: MessagePrinter::new(false, io::empty()) }
    }
}

impl FactReader {
    /// The fact of an event that the client has just returned, at this time of the host, ns.
    pub fn fact(&mut self, client: &Client, event: &Event, now_ns: u64) -> Fact {
        if *event == Event::Hello {
            self.panels = client.layout().map_or_else(|| Panels::from([]), panels);
        }
        // Numbers, texts and keys that are texts: this cannot fail.
        let line = self.messages.message(client, event).unwrap_or_default();
        let values = match event {
            Event::Frame { image: ImageNews::Whole, .. } => client.image().map(|(_, image)| image.to_vec()),
            Event::Raw { whole: true, .. } => Some(client.raw().to_vec()),
            _ => None,
        };
        let host_us = line.get("host_time_us").and_then(Value::as_u64);
        let host_ns = host_us.map_or(now_ns, |us| us.saturating_mul(1000));
        Fact { line, host_ns, values, panels: self.panels.clone() }
    }
}
