//! The TypeScript types of the page's messages, from their schemas. TAXEL_BLESS=1 updates the file.

use crate::start::root;
use serde_json::{Map, Value};
use std::fmt::Write;
use taxel_cli::view::schemas::derived;

const HEAD: &str = "// Messages between the program and the page, by the names of their structs in \
    host/cli/src/view/lines.rs,\n// host/cli/src/folding.rs, host/cli/src/on_robot/lines.rs, host/taxel/src/json/lines\n// and host/taxel/src/mind/line.rs. Made from these by \
    host/cli/tests/program/page_types.rs:\n// TAXEL_BLESS=1 updates it.\n";

/// Longest array that is written as a tuple.
const TUPLE: u64 = 4;

/// The type of a schema's values; `indent` is that of the line on which it begins.
fn typed(schema: &Value, indent: usize) -> String {
    if let Some(value) = schema.get("const") {
        return value.to_string();
    }
    for alternatives in ["oneOf", "anyOf"] {
        if let Some(any) = schema[alternatives].as_array() {
            return union(any.iter().map(|one| typed(one, indent)));
        }
    }
    match &schema["type"] {
        Value::Array(kinds) => union(kinds.iter().map(|kind| of_kind(kind, schema, indent))),
        kind => of_kind(kind, schema, indent),
    }
}

fn union(types: impl Iterator<Item = String>) -> String {
    types.collect::<Vec<_>>().join(" | ")
}

fn of_kind(kind: &Value, schema: &Value, indent: usize) -> String {
    match kind.as_str().expect("a schema has a type") {
        "integer" | "number" => "number".into(),
        "array" => list(schema, indent),
        "object" => match (schema["properties"].as_object(), &schema["additionalProperties"]) {
            (Some(fields), _) => object(fields, schema, indent),
            (None, others) => format!("Record<string, {}>", typed(others, indent)),
        },
        plain @ ("string" | "boolean" | "null") => plain.into(),
        other => panic!("{other} is unknown"),
    }
}

fn list(schema: &Value, indent: usize) -> String {
    let items = &schema["items"];
    if let Some(each) = items.as_array() {
        return format!("[{}]", each.iter().map(|item| typed(item, indent)).collect::<Vec<_>>().join(", "));
    }
    let item = typed(items, indent);
    let [least, most] = ["minItems", "maxItems"].map(|end| schema[end].as_u64());
    match most.filter(|most| least == Some(*most) && *most <= TUPLE) {
        Some(length) => format!("[{}]", vec![item; length as usize].join(", ")),
        None if item.contains(" | ") && !item.starts_with('{') => format!("({item})[]"),
        None => format!("{item}[]"),
    }
}

fn object(fields: &Map<String, Value>, schema: &Value, indent: usize) -> String {
    let required =
        |name: &String| schema["required"].as_array().is_some_and(|all| all.contains(&name[..].into()));
    let space = " ".repeat(indent + 2);
    let mut text = String::from("{\n");
    for (name, field) in fields {
        if let Some(says) = field["description"].as_str() {
            let _ = writeln!(text, "{space}/** {} */", says.replace('\n', " "));
        }
        let mark = if required(name) { "" } else { "?" };
        let _ = writeln!(text, "{space}{name}{mark}: {};", typed(field, indent + 2));
    }
    text + &" ".repeat(indent) + "}"
}

#[test]
fn types_are_derived_from_the_structs() {
    let mut want = String::from(HEAD);
    for (name, schema) in derived() {
        let says = schema["description"].as_str().expect("every message says what it is").replace('\n', " ");
        let _ = write!(want, "\n/** {says} */\nexport type {name} = {};\n", typed(&schema, 0));
    }
    let file = root().join("host/cli/src/view/page/messages.d.ts");
    if std::env::var_os("TAXEL_BLESS").is_some() {
        std::fs::write(&file, &want).expect("it can be written");
    }
    let have = std::fs::read_to_string(&file).expect("it is checked in");
    assert!(have == want, "{} is not what TAXEL_BLESS=1 writes", file.display());
}
