//! The classes of events in Python, from the schemas of the messages. TAXEL_BLESS=1 updates the file.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;
use taxel::json::lines::JsonLine;
use taxel::mind::RobotMeaningLine;
use taxel::robot::BoardLine;

/// Longest line of the file.
const WIDTH: usize = 119;

/// Head of the file.
const HEAD: &str = r#""""Events and their parts, typed. Made from the structs of the messages by host/taxel/tests/library/python_types.rs:
TAXEL_BLESS=1 updates it."""

from __future__ import annotations

from typing import Any, final

from . import _taxel
from ._field import Field, Part, each
from ._taxel import Event
"#;

/// Structs whose class has another name than theirs without `Line`, by what schemas call them.
const NAMES: [(&str, &str); 6] = [
    ("board", "BoardState"),
    ("StartLine", "Boot"),
    ("MeaningOfTouch", "Meaning"),
    ("LandedLine", "PlacedContact"),
    ("DoubtLine", "FoldDoubt"),
    ("RobotTouchLine", "RobotTouch"),
];

/// Events with arrays, which are made in Rust: these attributes are theirs.
const ARRAYS: [(&str, &[&str]); 3] =
    [("Frame", &["contacts", "released", "panels"]), ("Raw", &[]), ("Contacts", &["contacts", "released"])];

/// Attributes that all events have.
const OF_ALL: [&str; 2] = ["type", "board"];

/// The schemas of all structs that a message needs, by their names.
fn structs<T: JsonSchema>() -> (Value, Map<String, Value>) {
    let settings = SchemaSettings::draft07().for_serialize().with(|settings| settings.meta_schema = None);
    let mut schema = settings.into_generator().into_root_schema_for::<T>().to_value();
    let parts = schema["definitions"].as_object_mut().map(std::mem::take).unwrap_or_default();
    (schema, parts)
}

/// Name of the class of a struct, or of a message by its type.
fn class(name: &str) -> String {
    if let Some((_, class)) = NAMES.iter().find(|(own, _)| *own == name) {
        return (*class).into();
    }
    let words = name.strip_suffix("Line").unwrap_or(name).split('_');
    words.map(|word| word[..1].to_uppercase() + &word[1..]).collect()
}

/// A type in Python, and what makes its value of what JSON holds; empty if it is that.
struct Typed {
    python: String,
    maker: String,
}

impl Typed {
    fn plain(python: impl Into<String>) -> Typed {
        Typed { python: python.into(), maker: String::new() }
    }

    fn optional(self) -> Typed {
        Typed { python: format!("{} | None", self.python), ..self }
    }
}

/// Name of the struct that a schema refers to.
fn referred(schema: &Value) -> Option<&str> {
    let found = schema["$ref"].as_str().or_else(|| schema["allOf"][0]["$ref"].as_str())?;
    found.rsplit('/').next()
}

fn typed(schema: &Value) -> Typed {
    if let Some(name) = referred(schema) {
        return Typed { python: class(name), maker: class(name) };
    }
    if let Some(any) = schema["anyOf"].as_array() {
        return typed(&any[0]).optional();
    }
    match &schema["type"] {
        Value::Array(kinds) => of_kind(kinds[0].as_str().unwrap(), schema).optional(),
        Value::String(kind) => of_kind(kind, schema),
        _ => Typed::plain("Any"),
    }
}

fn of_kind(kind: &str, schema: &Value) -> Typed {
    match kind {
        "integer" => Typed::plain("int"),
        "number" => Typed::plain("float"),
        "string" => Typed::plain("str"),
        "boolean" => Typed::plain("bool"),
        "array" => {
            let Typed { python, maker } = typed(&schema["items"]);
            let length = schema["maxItems"].as_u64().filter(|most| schema["minItems"] == *most);
            match (length, maker.is_empty()) {
                (Some(length), _) => Typed {
                    python: format!("tuple[{}]", vec![python; length as usize].join(", ")),
                    maker: "tuple".into(),
                },
                (None, true) => Typed::plain(format!("list[{python}]")),
                (None, false) => Typed { python: format!("list[{python}]"), maker: format!("each({maker})") },
            }
        }
        "object" => Typed::plain(format!("dict[str, {}]", typed(&schema["additionalProperties"]).python)),
        other => panic!("{other} is unknown"),
    }
}

/// The attributes of an event that are made in Rust.
fn made_in_rust(name: &str) -> Option<&'static [&'static str]> {
    ARRAYS.iter().find(|(own, _)| *own == name).map(|(_, fields)| *fields)
}

/// Writes the class of an event or of a part of one.
fn write(text: &mut String, name: &str, schema: &Value, is_event: bool) {
    let made = if is_event { made_in_rust(name) } else { None };
    let base = match (made, is_event) {
        (Some(_), _) => format!("_taxel.{name}"),
        (None, true) => "Event".into(),
        (None, false) => "Part".into(),
    };
    let says = schema["description"].as_str().unwrap_or_else(|| panic!("{name} says nothing"));
    let _ = write!(text, "\n\n@final\nclass {name}({base}):\n    \"\"\"{}\"\"\"\n\n", plain(says));
    let required =
        |name: &String| schema["required"].as_array().is_some_and(|all| all.contains(&name[..].into()));
    for (field, schema) in schema["properties"].as_object().into_iter().flatten() {
        if made.is_some_and(|made| made.contains(&&field[..])) || is_event && OF_ALL.contains(&&field[..]) {
            continue;
        }
        let some = typed(schema);
        let is_there = required(field) || some.python.ends_with("None");
        let Typed { python, maker } = if is_there { some } else { some.optional() };
        let says = schema["description"].as_str().unwrap_or_else(|| panic!("{name}.{field} says nothing"));
        let maker = if maker.is_empty() { maker } else { format!("{maker}, ") };
        let line = format!("    {field} = Field[{python}]({maker}\"{}\")", plain(says));
        text.push_str(&wrapped(&line));
    }
}

/// What Rust's docs say, as Python's do.
fn plain(says: &str) -> String {
    says.replace('`', "``")
        .replace('"', "\\\"")
        .replace("null", "None")
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// A line in lines of at most 119 characters, parted in its text.
fn wrapped(line: &str) -> String {
    if line.chars().count() <= WIDTH {
        return format!("{line}\n");
    }
    let (head, says) = line.split_at(line.find('"').expect("it has a text"));
    let mut text = format!("{}\n", head.trim_end());
    let mut rest = &says[1..says.len() - 2];
    while !rest.is_empty() {
        let fits = rest.char_indices().map(|(at, c)| at + c.len_utf8()).take(WIDTH - 10).last().unwrap_or(0);
        let end = if fits == rest.len() { fits } else { rest[..fits].rfind(' ').expect("it has words") + 1 };
        let _ = writeln!(text, "        \"{}\"", &rest[..end]);
        rest = &rest[end..];
    }
    text + "    )\n"
}

/// Names of the structs that a struct holds, innermost first.
fn needed(schema: &Value, parts: &Map<String, Value>, into: &mut Vec<String>) {
    if let Some(name) = referred(schema).filter(|name| !into.iter().any(|known| known == name)) {
        needed(&parts[name], parts, into);
        into.push(name.into());
    }
    let inner = match schema {
        Value::Object(fields) => fields.values().collect::<Vec<_>>(),
        Value::Array(items) => items.iter().collect(),
        _ => return,
    };
    inner.into_iter().for_each(|one| needed(one, parts, into));
}

#[test]
fn classes_are_derived_from_the_structs() {
    let (all, mut parts) = structs::<JsonLine<'static>>();
    let mut events: Vec<(String, Value)> = Vec::new();
    for line in all["anyOf"].as_array().expect("a message is one of many") {
        let name = referred(line).expect("each is a struct");
        events.push((class(name), parts[name].clone()));
    }
    for (schema, more) in [structs::<RobotMeaningLine>(), structs::<BoardLine<'static>>()] {
        let kind = schema["properties"]["type"]["const"].as_str().expect("it has a type");
        events.push((class(kind), schema.clone()));
        parts.extend(more);
    }
    let (mut text, mut written) = (String::from(HEAD), BTreeSet::new());
    for (name, schema) in &events {
        let arrays = made_in_rust(name).unwrap_or_default();
        let mut own = Vec::new();
        for (field, schema) in schema["properties"].as_object().unwrap() {
            if !arrays.contains(&&field[..]) {
                needed(schema, &parts, &mut own);
            }
        }
        for part in own {
            if written.insert(part.clone()) {
                write(&mut text, &class(&part), &parts[&part], false);
            }
        }
        write(&mut text, name, schema, true);
    }
    text.push_str("\n\n#: The class of each type of message.\nCLASSES: dict[str, type[Event]] = {\n");
    for (name, schema) in &events {
        let _ = writeln!(text, "    {}: {name},", schema["properties"]["type"]["const"]);
    }
    text.push_str("}\n");
    let mut names: Vec<String> = events.iter().map(|(name, _)| name.clone()).collect();
    names.extend(written.iter().map(|part| class(part)));
    names.sort_unstable();
    text.push_str("\n__all__ = [\n");
    names.iter().for_each(|name| _ = writeln!(text, "    \"{name}\","));
    text.push_str("]\n");
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../python/python/taxel/_events.py");
    if std::env::var_os("TAXEL_BLESS").is_some() {
        std::fs::write(&file, &text).expect("it can be written");
    }
    let have = std::fs::read_to_string(&file).expect("it is checked in");
    assert!(have == text, "{} is not what TAXEL_BLESS=1 writes", file.display());
}
