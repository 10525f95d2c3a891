//! The schemas of the messages about the robot's mind are those of their structs. TAXEL_BLESS=1 updates the files.

use serde_json::Value;
use std::path::Path;
use taxel::mind::{
    HOST_INPUT, HOST_INPUT_SCHEMA, ROBOT_INTENT, ROBOT_INTENT_SCHEMA, host_input_schema, robot_intent_schema,
};

/// Name, shipped and derived schema.
fn all() -> [(&'static str, &'static str, Value); 2] {
    let [[intent, _], [reported, _]] = [robot_intent_schema(), host_input_schema()];
    [(ROBOT_INTENT, ROBOT_INTENT_SCHEMA, intent), (HOST_INPUT, HOST_INPUT_SCHEMA, reported)]
}

#[test]
fn the_schemas_of_the_mind_are_derived() {
    let all = all().map(|(name, shipped, derived)| {
        (name, shipped, format!("{}\n", serde_json::to_string_pretty(&derived).unwrap()))
    });
    if std::env::var_os("TAXEL_BLESS").is_some() {
        for (name, _, want) in &all {
            let file = format!("schemas/messages/{name}.json");
            std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join(file), want).unwrap();
        }
    }
    for (name, shipped, want) in all {
        assert!(shipped == want, "{name}.json is not what TAXEL_BLESS=1 writes");
    }
}
