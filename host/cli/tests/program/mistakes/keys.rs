//! The keys of a schema.

use serde_json::Value;

/// Keys that a schema allows, such as `/blocks/orientation/mirror_x`, sorted.
pub fn of(schema: &str) -> Vec<String> {
    let schema: Value = serde_json::from_str(schema).expect("a schema is JSON");
    let mut found = Vec::new();
    allowed(&schema, &schema, "", &mut found);
    found.sort();
    found.dedup();
    found
}

fn allowed(schema: &Value, root: &Value, path: &str, found: &mut Vec<String>) {
    let there = schema.get("$ref").and_then(Value::as_str);
    let schema = there.map_or(schema, |name| root.pointer(&name[1..]).expect("it leads somewhere"));
    if let Some(items) = schema.get("items") {
        allowed(items, root, path, found);
    }
    for any in schema.get("anyOf").and_then(Value::as_array).into_iter().flatten() {
        allowed(any, root, path, found);
    }
    for (key, value) in schema.get("properties").and_then(Value::as_object).into_iter().flatten() {
        let path = format!("{path}/{key}");
        allowed(value, root, &path, found);
        found.push(path);
    }
}

/// Asserts that a value of a file with every key has exactly the keys that a schema allows.
#[track_caller]
pub fn assert_all(value: &impl serde::Serialize, schema: &str) {
    let mut found = Vec::new();
    in_value(&serde_json::to_value(value).expect("a value is JSON"), "", &mut found);
    found.sort();
    found.dedup();
    assert_eq!(found, of(schema));
}

/// Keys of a value, in the form of those of a schema.
fn in_value(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(table) => {
            for (key, value) in table {
                let path = format!("{path}/{key}");
                in_value(value, &path, found);
                found.push(path);
            }
        }
        Value::Array(items) => items.iter().for_each(|item| in_value(item, path, found)),
        _ => {}
    }
}

/// Keys of a table of mistakes, sorted.
pub fn of_mistakes(mistakes: &[super::Mistake]) -> Vec<String> {
    let mut keys: Vec<String> = mistakes.iter().map(|(key, ..)| key.to_string()).collect();
    keys.sort();
    keys.dedup();
    keys
}
