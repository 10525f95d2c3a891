//! Zenoh's configuration, and sessions that are opened by it.
//!
//! A file is Zenoh's own, and all that it says counts: endpoints, TLS, users, access rules. What it does not say is
//! ours where Zenoh's default would reach beyond this machine: no scouting by multicast, nothing is listened
//! to, and no message above 16 MiB is taken. Without a file the network is this machine: whoever offers a board first routes for all others, by
//! the port that Zenoh's own router would take.

use crate::error::{Context, Result, SourceError, UsageError};
use crate::files::input;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use zenoh::{Config, Session, Wait};

/// Variable of the environment that names a file, as for Zenoh's own programs.
const VARIABLE: &str = "ZENOH_CONFIG";
/// Longest message that is taken, bytes: far above all of taxel's, for what a router passes on for others.
const LONGEST: usize = 16 << 20;
/// Place at which programs on this machine meet.
const MEETING: &str = "tcp/127.0.0.1:7447";

/// Role of a program in the network.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NetworkEnd {
    /// Program that offers boards.
    Offer,
    /// Program that follows a board of another machine.
    Viewer,
}

/// Opens a session by this file, else by the one that the environment names, else on this machine alone. Error if
/// the file cannot be used, or nobody can be reached.
pub fn open(end: NetworkEnd, file: Option<&Path>) -> Result<Session> {
    let named = std::env::var_os(VARIABLE).filter(|name| !name.is_empty()).map(PathBuf::from);
    let Some(file) = file.map(PathBuf::from).or(named) else { return alone(end) };
    let settings = read(&file)?;
    let shown = file.display();
    zenoh::open(checked(&file, &settings)?)
        .wait()
        .map_err(|why| error!(SourceError::NoBoard, "no network by {shown}: {}", said(&why)))
}

/// A session on this machine.
fn alone(end: NetworkEnd) -> Result<Session> {
    let config = |settings: Value| Config::from_json5(&settings.to_string());
    if end == NetworkEnd::Offer {
        let here = json!({ "mode": "router", "listen": { "endpoints": [MEETING] }, "scouting": quiet(),
            "transport": bounded() });
        let opened = config(here).and_then(|config| zenoh::open(config).wait());
        if let Ok(session) = opened {
            return Ok(session);
        }
    }
    // The port is taken, by a router or by another program that offers boards; or nobody is there.
    let there = json!({ "mode": "client", "connect": { "endpoints": [MEETING] }, "scouting": quiet(),
        "transport": bounded() });
    let opened = config(there).and_then(|config| zenoh::open(config).wait());
    opened.map_err(|why| {
        error!(
            SourceError::NoBoard,
            "no network: nobody offers a board on this machine, and no file ({VARIABLE}) names another: {}",
            said(&why)
        )
    })
}

/// Nobody is looked for.
fn quiet() -> Value {
    json!({ "multicast": { "enabled": false } })
}

/// Nothing endless is taken.
fn bounded() -> Value {
    json!({ "link": { "rx": { "max_message_size": LONGEST } } })
}

/// Reads a file, and adds what it leaves to us.
fn read(file: &Path) -> Result<Map<String, Value>> {
    let text = input::text(file).with_context(|| format!("{} cannot be read", file.display()))?;
    let settings: Value = json5::from_str(&text)
        .map_err(|why| error!(UsageError::Argument, "{}: it is not JSON5: {why}", file.display()))?;
    let Value::Object(mut settings) = settings else {
        fail!(UsageError::Argument, "{}: it holds no settings in braces", file.display());
    };
    unless_said(&mut settings, &["listen", "endpoints"], json!([]));
    unless_said(&mut settings, &["scouting", "multicast", "enabled"], json!(false));
    unless_said(&mut settings, &["mode"], json!("client"));
    unless_said(&mut settings, &["transport", "link", "rx", "max_message_size"], json!(LONGEST));
    Ok(settings)
}

/// Sets a value, unless the settings have one there.
fn unless_said(settings: &mut Map<String, Value>, key: &[&str], value: Value) {
    match key {
        [last] => drop(settings.entry(*last).or_insert(value)),
        [first, rest @ ..] => {
            let inner = settings.entry(*first).or_insert(json!({}));
            inner.as_object_mut().into_iter().for_each(|inner| unless_said(inner, rest, value.clone()));
        }
        [] => {}
    }
}

/// Zenoh's configuration of these settings. Error with the key that it does not take.
fn checked(file: &Path, settings: &Map<String, Value>) -> Result<Config> {
    let config = |settings: &Value| Config::from_json5(&settings.to_string());
    let whole = config(&Value::Object(settings.clone()));
    whole.map_err(|why| {
        let alone = settings.iter().find_map(|(key, value)| {
            let mut one = Map::new();
            one.insert(key.clone(), value.clone());
            config(&Value::Object(one)).err().map(|why| (format!(": {key}"), why))
        });
        let (key, why) = alone.unwrap_or((String::new(), why));
        error!(UsageError::Argument, "{}{key}: {}", file.display(), said(&why))
    })
}

/// Zenoh's words, without the places in its source.
pub(crate) fn said(why: &zenoh::Error) -> String {
    let text = why.to_string();
    let words = text.split(" at /").next().unwrap_or_default();
    words.trim().trim_end_matches(['.', '!']).to_string()
}
