//! A validator for the part of JSON Schema (draft 7) that our schemas use.

use serde_json::Value;

/// First violation of a schema with its place; none if the value is valid. Panics at an unknown keyword of
/// the schema, so that none is ignored.
pub fn wrong(value: &Value, schema: &Value) -> Option<String> {
    check(value, schema, schema, "")
}

fn check(value: &Value, schema: &Value, root: &Value, at: &str) -> Option<String> {
    let rules = schema.as_object().expect("a schema is an object");
    rules.iter().find_map(|(rule, wanted)| {
        let holds = match rule.as_str() {
            "$schema" | "title" | "description" | "default" | "definitions" => true,
            "$ref" => return check(value, target(wanted, root), root, at),
            "anyOf" => wanted.as_array().unwrap().iter().any(|any| check(value, any, root, at).is_none()),
            "const" => value == wanted,
            "enum" => wanted.as_array().unwrap().contains(value),
            "type" => is_one_of(type_of(value), wanted),
            "minimum" => value.as_f64().is_none_or(|number| number >= wanted.as_f64().unwrap()),
            "maximum" => value.as_f64().is_none_or(|number| number <= wanted.as_f64().unwrap()),
            "maxLength" => value.as_str().is_none_or(|text| text.chars().count() <= size(wanted)),
            "minItems" => value.as_array().is_none_or(|items| items.len() >= size(wanted)),
            "maxItems" => value.as_array().is_none_or(|items| items.len() <= size(wanted)),
            "items" => return items(value, wanted, root, at),
            "properties" => return properties(value, wanted, root, at),
            "required" => {
                let there = |name: &Value| value.get(name.as_str().unwrap()).is_some();
                !value.is_object() || wanted.as_array().unwrap().iter().all(there)
            }
            "additionalProperties" => {
                let known = |name: &String| schema["properties"].get(name).is_some();
                let others = value.as_object().into_iter().flatten().filter(|(name, _)| !known(name));
                match wanted {
                    Value::Bool(any) => *any || others.count() == 0,
                    wanted => others.into_iter().all(|(_, value)| check(value, wanted, root, at).is_none()),
                }
            }
            other => panic!("the schema has {other}, which is not checked"),
        };
        (!holds).then(|| format!("{at}: {rule} {wanted}"))
    })
}

/// An integer is a number; `wanted` is a type or a list of types.
fn is_one_of(is: &str, wanted: &Value) -> bool {
    match wanted {
        Value::Array(many) => many.iter().any(|one| is_one_of(is, one)),
        wanted => wanted == is || (is == "integer" && wanted == "number"),
    }
}

fn target<'a>(reference: &Value, root: &'a Value) -> &'a Value {
    let path = reference.as_str().unwrap().strip_prefix('#').unwrap();
    root.pointer(path).expect("a reference leads somewhere")
}

fn items(value: &Value, schema: &Value, root: &Value, at: &str) -> Option<String> {
    let all = value.as_array()?.iter().enumerate();
    all.into_iter().find_map(|(index, item)| check(item, schema, root, &format!("{at}/{index}")))
}

fn properties(value: &Value, schemas: &Value, root: &Value, at: &str) -> Option<String> {
    let known = value.as_object()?.iter().filter_map(|(name, value)| Some((name, value, schemas.get(name)?)));
    known.into_iter().find_map(|(name, value, schema)| check(value, schema, root, &format!("{at}/{name}")))
}

fn size(wanted: &Value) -> usize {
    wanted.as_u64().unwrap() as usize
}

fn type_of(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(number) if number.is_f64() => "number",
        Value::Number(_) => "integer",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    }
}
