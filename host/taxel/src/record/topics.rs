//! Topics of a recording, and which events go to which.

use super::raw_image::{PROTOBUF, RAW_IMAGE, schema};
use super::schemas::JSON;
use crate::client::Event;
use crate::error::Result;
use crate::recording::{Format, Store, WIRE, Writer, of_board};
use crate::source::array::ORIGINAL;
use serde_json::Value;

/// Frames of the wire to the board.
pub const REQUESTS: &str = "/taxel/requests";
/// Images.
pub const IMAGE: &str = "/taxel/image";
/// Encoding of the wire, described in `taxel_core::wire`.
const WIRE_ENCODING: &str = "taxel-wire";
/// Encoding of an array's bytes: see [`OriginalBytes::message`](crate::source::array::OriginalBytes::message).
const ORIGINAL_ENCODING: &str = "taxel-original";

/// Topic of a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordTopic {
    /// Frames of the wire from the board.
    Wire,
    /// Frames of the wire to the board.
    Requests,
    /// Bytes of an array.
    Original,
    /// Images.
    Image,
    /// The JSON topic of this name.
    Json(&'static str),
}

/// Channel numbers in one file.
#[derive(Debug, Clone)]
pub struct Topics {
    /// Channel of [`WIRE`].
    pub wire: u16,
    requests: u16,
    original: u16,
    image: u16,
    json: Vec<(&'static str, u16)>,
}

impl Topics {
    /// Declares the channels in a file: those of its only board, or of this one of a robot.
    pub fn open<S: Store>(writer: &mut Writer<S>, board: Option<&str>) -> Result<Topics> {
        let plain = Format { encoding: WIRE_ENCODING, schema: "", schema_encoding: "", text: b"" };
        let (wire, requests) = (of_board(board, WIRE), of_board(board, REQUESTS));
        let (wire, requests) = (writer.channel(&wire, &plain)?, writer.channel(&requests, &plain)?);
        let bytes = Format { encoding: ORIGINAL_ENCODING, ..plain };
        let original = writer.channel(&of_board(board, ORIGINAL), &bytes)?;
        let raw =
            Format { encoding: PROTOBUF, schema: RAW_IMAGE, schema_encoding: PROTOBUF, text: &schema() };
        let image = writer.channel(&of_board(board, IMAGE), &raw)?;
        let mut json = Vec::new();
        for (name, text) in JSON {
            // Without the spaces of the file.
            let text = serde_json::from_str::<Value>(text)?.to_string();
            let title = format!("taxel.{name}");
            let format = Format {
                encoding: "json",
                schema: &title,
                schema_encoding: "jsonschema",
                text: text.as_bytes(),
            };
            let topic = of_board(board, &format!("/taxel/{name}"));
            json.push((name, writer.channel(&topic, &format)?));
        }
        Ok(Topics { wire, requests, original, image, json })
    }

    /// The channel of a message.
    pub fn channel(&self, topic: RecordTopic) -> Option<u16> {
        match topic {
            RecordTopic::Wire => Some(self.wire),
            RecordTopic::Requests => Some(self.requests),
            RecordTopic::Original => Some(self.original),
            RecordTopic::Image => Some(self.image),
            RecordTopic::Json(name) => self.json.iter().find(|(known, _)| *known == name).map(|(_, id)| *id),
        }
    }
}

/// JSON topic of an event; none if it is only on the wire.
pub fn of(event: &Event) -> Option<&'static str> {
    Some(match event {
        Event::Hello => "hello",
        Event::Frame { .. } => "frames",
        Event::Contacts { .. } => "contacts",
        Event::Symbols(_) => "symbols",
        Event::Intent(_) => "intent",
        Event::Reaction(_) => "reactions",
        Event::Health(_) => "health",
        Event::HealthMap { .. } => "health_map",
        Event::Budget(_) => "budget",
        Event::Temperature(_) => "temperature",
        Event::Gesture(_) => "gestures",
        Event::SelfTest(_) => "self_test",
        Event::Pressing(_) => "pressing",
        Event::Regions(_) => "regions",
        Event::Log { .. } | Event::Note { .. } => "log",
        Event::Lost { .. } => "lost",
        Event::Back { .. } => "back",
        Event::Other { .. } => "other",
        _ => return None,
    })
}
