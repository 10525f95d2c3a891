//! JSON schemas of messages, derived from their structs.

use schemars::generate::SchemaSettings;
use schemars::transform::Transform;
use schemars::{JsonSchema, Schema};
use serde_json::{Value, json};

/// Adds the field `type` of a message, which is the name of its struct and none of its fields.
#[derive(Debug, Clone, Copy)]
pub struct TypeIs(pub &'static str);

impl Transform for TypeIs {
    fn transform(&mut self, schema: &mut Schema) {
        let fields = schema.ensure_object();
        if let Some(Value::Object(properties)) = fields.get_mut("properties") {
            let kind = json!({ "type": "string", "const": self.0, "description": "Type of the message." });
            properties.shift_insert(0, "type".into(), kind);
        }
        if let Some(Value::Array(required)) = fields.get_mut("required") {
            required.insert(0, "type".into());
        }
    }
}

/// The schema of a message as it is written, without references.
pub fn of<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft07().for_serialize().with(|settings| {
        settings.inline_subschemas = true;
        settings.meta_schema = None;
    });
    let mut schema = settings.into_generator().into_root_schema_for::<T>().to_value();
    each(&mut schema, &|fields| {
        // The names of Rust's types.
        fields.shift_remove("title");
        fields.shift_remove("format");
    });
    schema
}

/// The schema for programs that show recordings: they want one type a field, and take null for absent.
pub fn plain<T: JsonSchema>() -> Value {
    let mut schema = of::<T>();
    each(&mut schema, &|fields| {
        if let Some(Value::Array(types)) = fields.get("type") {
            let kind = types.iter().find(|kind| *kind != "null").cloned();
            fields["type"] = kind.unwrap_or_default();
        }
    });
    schema
}

/// Changes each schema in a schema. A field of a message may be named like a keyword: it is not one.
fn each(schema: &mut Value, change: &dyn Fn(&mut serde_json::Map<String, Value>)) {
    let Value::Object(fields) = schema else { return };
    change(fields);
    for (keyword, inner) in fields.iter_mut() {
        match inner {
            Value::Object(named) if keyword == "properties" => {
                named.values_mut().for_each(|field| each(field, change));
            }
            Value::Array(many) if keyword != "required" && keyword != "enum" => {
                many.iter_mut().for_each(|one| each(one, change));
            }
            inner => each(inner, change),
        }
    }
}
