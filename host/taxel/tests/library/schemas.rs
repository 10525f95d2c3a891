//! The schemas of recordings are those of the messages' structs, and messages are what they say.
//! TAXEL_BLESS=1 updates the files.

use super::validator::wrong;
use schemars::generate::SchemaSettings;
use serde_json::Value;
use std::path::Path;
use taxel::files::schemas::ROBOT;
use taxel::json::lines::JsonLine;
use taxel::json::schema;
use taxel::record::{TOPICS, derived};
use taxel::robot::RobotConfig;

#[test]
fn schemas_are_derived_from_the_structs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas/messages");
    for ((topic, _), [plain, _]) in TOPICS.into_iter().zip(derived()) {
        let file = folder.join(format!("{topic}.json"));
        let want = format!("{}\n", serde_json::to_string_pretty(&plain).unwrap());
        if std::env::var_os("TAXEL_BLESS").is_some() {
            std::fs::write(&file, &want).expect("it can be written");
        }
        let have = std::fs::read_to_string(&file).expect("it is checked in");
        assert!(have == want, "{} is not what TAXEL_BLESS=1 writes", file.display());
    }
}

#[test]
fn the_schema_of_robots_is_derived_from_the_struct() {
    let settings = SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true);
    let mut schema = settings.into_generator().into_root_schema_for::<RobotConfig>().to_value();
    schema["title"] = "A robot of taxel: its boards, and what they are asked".into();
    // TOML has no null: a key may be left out.
    let board = schema["properties"]["boards"]["items"]["properties"].take();
    let [mut robot, mut board] = [schema["properties"].take(), board];
    for field in
        [&mut robot, &mut board].into_iter().flat_map(|fields| fields.as_object_mut().unwrap().values_mut())
    {
        let field = field.as_object_mut().unwrap();
        field.shift_remove("format");
        field.shift_remove("default");
        if let Some(Value::Array(kinds)) = field.get("type") {
            let kind = kinds.iter().find(|kind| *kind != "null").cloned();
            field["type"] = kind.unwrap();
        }
        if let Some(Value::Array(kinds)) = field.shift_remove("anyOf") {
            let kind = kinds.into_iter().find(|kind| kind["type"] != "null").unwrap();
            field.extend(kind.as_object().unwrap().clone());
        }
    }
    robot["boards"]["items"]["properties"] = board;
    schema["properties"] = robot;
    let want = format!("{}\n", serde_json::to_string_pretty(&schema).unwrap());
    if std::env::var_os("TAXEL_BLESS").is_some() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas/robot.json");
        std::fs::write(file, &want).expect("it can be written");
    }
    assert!(ROBOT == want, "schemas/robot.json is not what TAXEL_BLESS=1 writes");
}

/// Foxglove's reader wants a known type of every field.
#[test]
fn every_field_has_one_type_and_says_what_it_is() {
    fn visit(schema: &Value, path: &str) {
        assert!(schema["description"].is_string() || path.ends_with("type") || path.is_empty(), "{path}");
        assert!(schema["type"].is_string() || path.ends_with("/fault"), "{path}: {schema}");
        for (name, field) in schema["properties"].as_object().into_iter().flatten() {
            visit(field, &format!("{path}/{name}"));
        }
        if let Some(items) = schema["items"]["properties"].as_object() {
            items.iter().for_each(|(name, field)| visit(field, &format!("{path}/0/{name}")));
        }
    }
    derived().iter().for_each(|[plain, _]| visit(plain, ""));
}

#[test]
fn messages_are_what_their_schemas_say() {
    let (all, topics) = (schema::of::<JsonLine<'static>>(), derived());
    let (mut lines, mut recorded) = (0, 0);
    for line in include_str!("golden/lines.txt").lines() {
        let (place, text) = line.split_at(line.find('{').unwrap());
        let value: Value = serde_json::from_str(text).unwrap();
        if !place.ends_with("replayed ") && !place.ends_with("recorded ") {
            assert_eq!(wrong(&value, &all), None, "{line}");
            lines += 1;
        }
        let of_kind = |[_, whole]: &&[Value; 2]| whole["properties"]["type"]["const"] == value["type"];
        if let Some([_, whole]) = topics.iter().find(of_kind).filter(|_| place.ends_with("recorded ")) {
            assert_eq!(wrong(&value, whole), None, "{line}");
            let known = |key: &String| whole["properties"].get(key).is_some();
            assert!(value.as_object().unwrap().keys().all(known), "{line}");
            recorded += 1;
        }
    }
    assert!(lines > 40 && recorded > 20, "{lines} {recorded}");
}
