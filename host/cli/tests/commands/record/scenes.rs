//! Every simulated scene, recorded and played.

use super::replayed::replayed;
use super::stage::{file, plan, record};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use taxel::recording::{HELLO, Messages, scan};
use taxel::sim;

#[test]
fn a_replay_is_the_board_bit_for_bit() {
    for scene in sim::list() {
        let name = scene.name;
        let seen = record(&format!("sim:{name}"), plan(&format!("{name}.mcap"), "sim", None, false));
        assert!(seen.frames.len() > 200, "{name}");
        assert!(seen == replayed(&file(&format!("{name}.mcap"))), "{name}");
        let found = scan(&file(&format!("{name}.mcap"))).unwrap();
        assert!(found.whole, "{name}");
        let attached: Vec<_> = found.contents.attachments().collect();
        assert_eq!(attached, [HELLO, "garment.toml", "scene.json", "geometry.json"]);
        assert_eq!(found.metadata[0].metadata["program"], concat!("taxel ", env!("CARGO_PKG_VERSION")));
    }
}

#[test]
fn messages_are_as_their_schemas_say() {
    // The one has reactions, the other is long enough for the board's counters.
    let mut checked = BTreeSet::new();
    for scene in ["lash", "press"] {
        let name = format!("schemas-{scene}.mcap");
        record(&format!("sim:{scene}"), plan(&name, "sim", None, false));
        check(&file(&name), &mut checked);
    }
    for topic in
        ["hello", "frames", "contacts", "symbols", "intent", "reactions", "health", "health_map", "budget"]
    {
        assert!(checked.contains(&format!("/taxel/{topic}")), "no message of {topic}");
    }
}

/// Checks every JSON message of a file; adds their topics to `checked`.
fn check(path: &Path, checked: &mut BTreeSet<String>) {
    let summary = mcap::Summary::read(&std::fs::read(path).unwrap()).unwrap().unwrap();
    let mut messages = Messages::open(path).unwrap();
    while let Some(message) = messages.next_message().unwrap() {
        let channel = &summary.channels[&message.header.channel_id];
        let Some(schema) = &channel.schema else { continue };
        if channel.message_encoding != "json" {
            continue;
        }
        let schema: Value = serde_json::from_slice(&schema.data).unwrap();
        let value: Value = serde_json::from_slice(message.data).unwrap();
        conforms(&value, &schema, &channel.topic);
        assert_eq!(value["host_time_us"].as_u64().unwrap() * 1000, message.header.log_time);
        assert_eq!(value["time_us"].as_u64().unwrap() * 1000, message.header.publish_time);
        checked.insert(channel.topic.clone());
    }
}

/// Checks that a value has the type of a schema, and no other fields.
fn conforms(value: &Value, schema: &Value, place: &str) {
    let fits = match schema["type"].as_str().unwrap() {
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number() || value.is_null(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "array" => value.as_array().is_some_and(|items| {
            items.iter().for_each(|item| conforms(item, &schema["items"], place));
            true
        }),
        "object" => value.as_object().is_some_and(|fields| {
            for (name, field) in fields {
                let known = schema["properties"].get(name).or(schema.get("additionalProperties"));
                let place = format!("{place}.{name}");
                conforms(field, known.unwrap_or_else(|| panic!("{place} is not in the schema")), &place);
            }
            true
        }),
        other => panic!("{place}: {other}"),
    };
    assert!(fits, "{place}: {value} is not {}", schema["type"]);
}
