//! An event as it leaves the client, complete, so that it is independent of what the client takes next.

use crate::array::{Panels, panels};
use serde_json::{Value, json};
use taxel::client::{Client, Event, ImageNews};
use taxel::json;
use taxel_core::format::Micros;

/// An event.
#[derive(Clone)]
pub struct Fact {
    /// Its JSON line.
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
#[derive(Debug)]
pub struct FactReader {
    panels: Panels,
}

impl Default for FactReader {
    fn default() -> FactReader {
        FactReader { panels: Panels::from([]) }
    }
}

impl FactReader {
    /// The fact of an event that the client has just returned, at this time of the host.
    pub fn fact(&mut self, client: &Client, event: &Event, now_ns: u64) -> Fact {
        if *event == Event::Hello {
            self.panels = client.layout().map_or_else(|| Panels::from([]), panels);
        }
        let mut line = json::message(client, event);
        let board = line.get("time_us").and_then(Value::as_u64);
        let host = board.and_then(|board| client.host_time(Micros(board)));
        if let Some(time) = host {
            line["host_time_us"] = json!(time.us);
            line["host_time_uncertainty_us"] = json!(time.uncertainty_us);
        }
        let values = match event {
            Event::Frame { image: ImageNews::Whole, .. } => client.image().map(|(_, image)| image.to_vec()),
            Event::Raw { whole: true, .. } => Some(client.raw().to_vec()),
            _ => None,
        };
        let host_ns = host.map_or(now_ns, |time| time.us.saturating_mul(1000));
        Fact { line, host_ns, values, panels: self.panels.clone() }
    }
}
