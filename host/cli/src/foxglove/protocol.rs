//! The part of Foxglove's WebSocket protocol that a send-only server needs.
//!
//! | message | from | what |
//! |---|---|---|
//! | `serverInfo`, `advertise`, `status` | server, text | the server; the channels with their schemas; the losses of a slow client |
//! | `subscribe`, `unsubscribe` | client, text | channels, each with a number chosen by the client |
//! | 1 (u8), subscription (u32), time (u64, ns), data | server, binary, little-endian | a message of a channel |

use serde_json::{Value, json};
use taxel::record::{IMAGE, JsonTopic, PROTOBUF, RAW_IMAGE, TOPICS, image_schema};

/// Names of the protocol, the newer first; the messages used here are the same in both.
pub const PROTOCOLS: [&str; 2] = ["foxglove.sdk.v1", "foxglove.websocket.v1"];

/// Number of a channel: 1 for the first topic.
pub type Channel = u32;

/// A request of a client.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ClientRequest {
    /// Numbers of subscriptions, each with its channel.
    Subscribe(Vec<(u32, Channel)>),
    /// Numbers of ended subscriptions.
    Unsubscribe(Vec<u32>),
}

/// Parses a client's message; none if it is not supported.
pub fn request(text: &str) -> Option<ClientRequest> {
    let said: Value = serde_json::from_str(text).ok()?;
    let number = |value: &Value| u32::try_from(value.as_u64()?).ok();
    match said["op"].as_str()? {
        "subscribe" => {
            let each = said["subscriptions"].as_array()?.iter();
            let pair = |one: &Value| Some((number(&one["id"])?, number(&one["channelId"])?));
            Some(ClientRequest::Subscribe(each.filter_map(pair).collect()))
        }
        "unsubscribe" => Some(ClientRequest::Unsubscribe(
            said["subscriptionIds"].as_array()?.iter().filter_map(number).collect(),
        )),
        _ => None,
    }
}

/// Channel of images, behind those of JSON.
pub const IMAGES: Channel = TOPICS.len() as Channel + 1;

/// Channel of a topic with JSON messages.
pub fn channel(topic: &str) -> Option<Channel> {
    (1..).zip(TOPICS).find(|(_, (name, _))| *name == topic).map(|(channel, _)| channel)
}

/// Message about the server.
pub fn server_info(label: &str) -> String {
    let program = concat!("taxel ", env!("CARGO_PKG_VERSION"));
    let name = format!("{program}: {label}");
    json!({
        "op": "serverInfo", "name": name, "capabilities": [], "supportedEncodings": ["json"],
        "metadata": { "program": program, "source": label }, "sessionId": std::process::id().to_string(),
    })
    .to_string()
}

/// Message about the channels: those of a recording.
pub fn advertise() -> String {
    let channel = |(id, (name, schema)): (Channel, JsonTopic)| {
        json!({
            "id": id, "topic": format!("/taxel/{name}"), "encoding": "json", "schemaName": format!("taxel.{name}"),
            "schema": schema, "schemaEncoding": "jsonschema",
        })
    };
    let mut channels: Vec<_> = (1..).zip(TOPICS).map(channel).collect();
    channels.push(json!({
        "id": IMAGES, "topic": IMAGE, "encoding": PROTOBUF, "schemaName": RAW_IMAGE,
        "schema": base64(&image_schema()), "schemaEncoding": PROTOBUF,
    }));
    json!({ "op": "advertise", "channels": channels }).to_string()
}

/// Bytes as text: the protocol is JSON.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let bits = three.iter().chain([&0; 2]).take(3).fold(0, |bits, byte| bits << 8 | usize::from(*byte));
        for digit in 0..4 {
            let is_there = digit <= three.len();
            text.push(if is_there { DIGITS[bits >> (18 - 6 * digit) & 63].into() } else { '=' });
        }
    }
    text
}

/// Message about a slow client's losses.
pub fn left_out(count: u64) -> String {
    let text = format!("{count} messages were left out: this program reads too slowly");
    json!({ "op": "status", "level": 1, "message": text, "id": "slow" }).to_string()
}

/// Message about too many subscriptions.
pub fn too_many(most: usize) -> String {
    let text = format!("a client can have {most} subscriptions: the others are ignored");
    json!({ "op": "status", "level": 1, "message": text, "id": "subscriptions" }).to_string()
}

/// Encodes a message for a subscription.
pub fn data(subscription: u32, ns: u64, data: &[u8]) -> Vec<u8> {
    let mut bytes = vec![1];
    bytes.extend(subscription.to_le_bytes());
    bytes.extend(ns.to_le_bytes());
    bytes.extend_from_slice(data);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_client_wants_is_read_and_nothing_else() {
        let wanted =
            r#"{"op":"subscribe","subscriptions":[{"id":7,"channelId":3},{"id":-1,"channelId":3},{}]}"#;
        assert_eq!(request(wanted), Some(ClientRequest::Subscribe(vec![(7, 3)])));
        assert_eq!(
            request(r#"{"op":"unsubscribe","subscriptionIds":[7, "x"]}"#),
            Some(ClientRequest::Unsubscribe(vec![7]))
        );
        for other in ["", "[]", "7", "{}", r#"{"op":7}"#, r#"{"op":"subscribe"}"#, r#"{"op":"advertise"}"#] {
            assert_eq!(request(other), None, "{other}");
        }
        assert_eq!((channel("hello"), channel("contacts"), channel("x")), (Some(1), Some(3), None));
        let texts = ["", "f", "fo", "foo", "foob"].map(|text| base64(text.as_bytes()));
        assert_eq!(texts, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]);
        assert_eq!(base64(&[0xFB, 0xFF]), "+/8=");
        assert_eq!(data(2, 3, b"{}"), [1, 2, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, b'{', b'}']);
    }
}
