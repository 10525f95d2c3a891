//! The pages of the reference that are made from what defines them: messages, files, options.
//! TAXEL_BLESS=1 updates them.

use crate::start::root;
use clap::{Arg, Command, CommandFactory};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt::Write;
use taxel::files::schemas::{GARMENT, ROBOT, SCENE, TOUCHES};
use taxel::json::{lines::JsonLine, schema};
use taxel_cli::cli::Cli;

/// Compares a page with the repository's, or writes it.
fn check(name: &str, page: &str) {
    let path = root().join("docs/reference").join(name);
    if std::env::var_os("TAXEL_BLESS").is_some() {
        std::fs::write(&path, page).expect("it can be written");
    }
    let have = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(have == page, "{} is not what TAXEL_BLESS=1 writes", path.display());
}

/// Text in a cell of a table.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|").replace('<', "&lt;")
}

/// A schema, with what it refers to in its place.
fn resolved(schema: &Value, whole: &Value) -> Map<String, Value> {
    let mut fields = schema.as_object().cloned().unwrap_or_default();
    if let Some(place) = schema["$ref"].as_str() {
        let aim = whole.pointer(place.trim_start_matches('#')).expect("the schema has it");
        resolved(aim, whole).into_iter().for_each(|(key, value)| _ = fields.entry(key).or_insert(value));
    }
    fields
}

/// The values that a schema permits, in words.
fn kind(schema: &Value, whole: &Value) -> String {
    let schema = &Value::Object(resolved(schema, whole));
    let list = |values: &Value| {
        let values = values.as_array().into_iter().flatten();
        values
            .map(|value| format!("`{}`", value.to_string().trim_matches('"')))
            .collect::<Vec<_>>()
            .join(", ")
    };
    if !schema["const"].is_null() {
        return list(&Value::Array(vec![schema["const"].clone()]));
    }
    if schema["enum"].is_array() {
        return list(&schema["enum"]);
    }
    if let Some(any) = schema["anyOf"].as_array().or(schema["oneOf"].as_array()) {
        let mut kinds: Vec<String> = any.iter().map(|one| kind(one, whole)).collect();
        kinds.dedup();
        return kinds.join(" or ");
    }
    let number = |key: &str| schema[key].as_f64().map(|value| value.to_string());
    let range = match (number("minimum"), number("maximum")) {
        (Some(low), Some(high)) => format!(", {low} to {high}"),
        (Some(low), None) => format!(", from {low}"),
        (None, Some(high)) => format!(", to {high}"),
        (None, None) => String::new(),
    };
    let one = |name: &str| match name {
        "integer" => format!("integer{range}"),
        "number" => format!("number{range}"),
        "array" => {
            let items = &schema["items"];
            format!("list of {}", if items.is_object() { kind(items, whole) } else { "values".into() })
        }
        "object" if schema["additionalProperties"].is_object() => {
            format!("{} by name", kind(&schema["additionalProperties"], whole))
        }
        "object" => "table".into(),
        name => name.to_string(),
    };
    match &schema["type"] {
        Value::Array(names) => {
            names.iter().filter_map(Value::as_str).map(one).collect::<Vec<_>>().join(" or ")
        }
        Value::String(name) => one(name),
        _ => "any".into(),
    }
}

/// Writes a row for each key below `path`.
fn rows(schema: &Value, whole: &Value, path: &str, page: &mut String) {
    let schema = Value::Object(resolved(schema, whole));
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        let field = Value::Object(resolved(field, whole));
        let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        let about = field["description"].as_str().unwrap_or_default();
        writeln!(page, "| `{path}` | {} | {} |", cell(&kind(&field, whole)), cell(about)).unwrap();
        let any = field["anyOf"].as_array().or(field["oneOf"].as_array());
        for inner in std::iter::once(&field).chain(any.into_iter().flatten()) {
            rows(inner, whole, &path, page);
            rows(&inner["items"], whole, &path, page);
        }
    }
}

#[test]
fn the_pages_of_files_are_fresh() {
    for (name, title, lead, text) in [
        (
            "garment.md",
            "A garment's file",
            "`taxel config new mine.toml` begins one, `taxel config check mine.toml` checks it.",
            GARMENT,
        ),
        (
            "scene.md",
            "A scene's file",
            "`taxel config scene calm.toml` begins one; a key that is left out is as in the scene that ships.",
            SCENE,
        ),
        (
            "touches.md",
            "A script of touches",
            "[Scripts of touches](../guides/touches.md) says what they are for.",
            TOUCHES,
        ),
        (
            "robot.md",
            "A robot's file",
            "[A robot of several boards](../guides/robot.md) says what it is for.",
            ROBOT,
        ),
    ] {
        let schema: Value = serde_json::from_str(text).unwrap();
        let mut page = format!(
            "# {title}\n\n{lead}\nMade from `taxel config schema`.\n\n| key | value | meaning |\n|---|---|---|\n"
        );
        rows(&schema, &schema, "", &mut page);
        check(name, &page);
    }
}

#[test]
fn the_page_of_messages_is_fresh() {
    let all = schema::of::<JsonLine<'static>>();
    let any = all["anyOf"].as_array().or(all["oneOf"].as_array()).expect("there are several");
    let named = |message: &Value| {
        Some((message["properties"]["type"]["const"].as_str()?.to_string(), message.clone()))
    };
    let messages: BTreeMap<String, Value> = any.iter().filter_map(named).collect();
    assert!(messages.len() > 20, "{} messages", messages.len());
    let mut page = "# The messages\n\nOne JSON object a line, as `taxel live --json` prints them; recordings, the page and \
        Python have the same keys.\nMade from the structs in `host/taxel/src/json/lines`.\n"
        .to_string();
    for (name, message) in &messages {
        let about = message["description"].as_str().unwrap_or_default();
        write!(page, "\n## {name}\n\n{about}\n\n| key | value | meaning |\n|---|---|---|\n").unwrap();
        rows(message, message, "", &mut page);
    }
    check("messages.md", &page);
}

fn words(text: Option<&clap::builder::StyledStr>) -> String {
    text.map(|text| cell(&text.to_string())).unwrap_or_default()
}

/// How an argument is written.
fn usage(arg: &Arg) -> String {
    let value = arg.get_value_names().filter(|_| arg.get_action().takes_values());
    let value = value.map(|names| names.join(" ")).unwrap_or_default();
    match (arg.get_long(), arg.get_short()) {
        (Some(long), short) => {
            let short = short.map(|short| format!("-{short}, ")).unwrap_or_default();
            format!("{short}--{long} {value}").trim_end().to_string()
        }
        (None, Some(short)) => format!("-{short} {value}").trim_end().to_string(),
        (None, None) => value,
    }
}

/// Row of a table for each argument that is shown.
fn arguments(command: &Command) -> Vec<(String, String)> {
    let shown = command.get_arguments().filter(|arg| !arg.is_hide_set() && arg.get_id() != "help");
    let row = |arg: &Arg| {
        let about = words(arg.get_long_help().or(arg.get_help()));
        (usage(arg), format!("| `{}` | {about} |\n", cell(&usage(arg))))
    };
    shown.map(row).collect()
}

/// The commands that do something, by name.
fn leaves<'a>(command: &'a Command, path: &str, found: &mut Vec<(String, &'a Command)>) {
    if command.get_subcommands().next().is_none() {
        found.push((path.to_string(), command));
    }
    for inner in command.get_subcommands().filter(|inner| !inner.is_hide_set() && inner.get_name() != "help")
    {
        leaves(inner, &format!("{path} {}", inner.get_name()), found);
    }
}

#[test]
fn the_page_of_options_is_fresh() {
    const SHARED: usize = 4;
    const HEAD: &str = "\n| argument | meaning |\n|---|---|\n";
    let (whole, mut commands) = (Cli::command(), Vec::new());
    leaves(&whole, "taxel", &mut commands);
    let mut times = BTreeMap::new();
    let all = commands.iter().flat_map(|(_, command)| arguments(command));
    all.for_each(|(_, row)| *times.entry(row).or_insert(0) += 1);
    let is_shared = |row: &String| times.get(row).is_some_and(|times| *times >= SHARED);

    let mut page = format!(
        "# Options of every command\n\n[The commands](commands.md) shows what they are for. Made from `taxel COMMAND \
        --help`.\n\n## Shared options\n\nOptions that {SHARED} commands or more have.\n{HEAD}"
    );
    times.keys().filter(|row| is_shared(row)).for_each(|row| page.push_str(row));
    for (path, command) in &commands {
        write!(page, "\n## {path}\n\n{}\n", words(command.get_about())).unwrap();
        let (shared, own): (Vec<_>, Vec<_>) =
            arguments(command).into_iter().partition(|(_, row)| is_shared(row));
        if !own.is_empty() {
            page.push_str(HEAD);
            own.iter().for_each(|(_, row)| page.push_str(row));
        }
        if !shared.is_empty() {
            let names: Vec<String> = shared.iter().map(|(usage, _)| format!("`{}`", cell(usage))).collect();
            write!(page, "\nShared: {}.\n", names.join(", ")).unwrap();
        }
    }
    check("options.md", &page);
}
