//! JSON schemas of the messages, so that Foxglove and others can offer the fields before any message.

use serde_json::{Map, Value, json};

type Fields<'a> = &'a [(&'a str, Value)];

fn is(kind: &str) -> Value {
    json!({ "type": kind })
}

fn integer() -> Value {
    is("integer")
}

fn number() -> Value {
    is("number")
}

fn text() -> Value {
    is("string")
}

fn flag() -> Value {
    is("boolean")
}

fn list(of: Value) -> Value {
    json!({ "type": "array", "items": of })
}

fn object(fields: Fields<'_>) -> Value {
    let properties: Map<String, Value> =
        fields.iter().map(|(name, value)| (name.to_string(), value.clone())).collect();
    json!({ "type": "object", "properties": properties })
}

/// Fields with these names, all of one type.
fn all<const N: usize>(kind: fn() -> Value, names: [&str; N]) -> Vec<(&str, Value)> {
    names.map(|name| (name, kind())).to_vec()
}

/// A message: type and times, then the other fields.
fn message(fields: &[(&str, Value)]) -> Value {
    let times = ["time_us", "host_time_us", "host_time_uncertainty_us"];
    object(&[&[("type", text())], all(integer, times).as_slice(), fields].concat())
}

/// A message about a scan.
fn of_frame(fields: &[(&str, Value)]) -> Value {
    message(&[&[("frame", integer())], fields].concat())
}

fn contact() -> Value {
    let integers = [
        "id",
        "panel",
        "total",
        "peak",
        "peak_row",
        "peak_column",
        "area",
        "edge",
        "perimeter",
        "peak_total",
        "form_age",
    ];
    let numbers = [
        "x",
        "y",
        "x_mm",
        "y_mm",
        "azimuth",
        "anisotropy",
        "breadth_mm",
        "nmi",
        "nmi_peak",
        "nmi_s2",
        "confidence",
        "dx",
        "dy",
        "vx",
        "vy",
        "duration",
        "peak_breadth_mm",
    ];
    let texts = ["phase", "panel_name", "region", "link", "shape"];
    object(
        &[all(integer, integers), all(number, numbers), all(text, texts), all(flag, ["slip", "unsure"])]
            .concat(),
    )
}

/// Garment, scene and firmware.
pub fn hello() -> Value {
    let panel = [
        all(text, ["name", "link", "region"]),
        all(integer, ["rows", "columns"]),
        vec![("pitch_um", list(integer()))],
    ];
    let fields = [
        all(text, ["firmware", "garment", "scene", "calibration"]),
        vec![("taxels", integer()), ("regions", list(text())), ("panels", list(object(&panel.concat())))],
    ];
    message(&fields.concat())
}

/// The conditioned image by panel and row, counts; `total` is their sum.
pub fn frames() -> Value {
    let panel = object(&[("name", text()), ("total", integer()), ("rows", list(list(integer())))]);
    let fields = [
        all(flag, ["key", "decoded"]),
        all(integer, ["lost", "thinned", "total"]),
        vec![("panels", list(panel))],
    ];
    of_frame(&fields.concat())
}

/// Present and released contacts.
pub fn contacts() -> Value {
    of_frame(&[("contacts", list(contact())), ("released", list(contact())), ("dropped", integer())])
}

/// Symbols of contacts.
pub fn symbols() -> Value {
    let words = [all(text, ["strength", "extent", "span", "class"]), vec![("moving", flag())]];
    let event = [
        all(integer, ["contact", "peak_total", "duration_ms"]),
        all(text, ["phase", "region"]),
        vec![("words", object(&words.concat()))],
    ];
    let region =
        [all(integer, ["contacts", "total", "peak", "since"]), vec![("region", text()), ("moving", flag())]];
    of_frame(&[("events", list(object(&event.concat()))), ("regions", list(object(&region.concat())))])
}

/// The leading intention, and each concept's activation, -1 ..= 1.
pub fn intent() -> Value {
    let concepts = json!({ "type": "object", "additionalProperties": number() });
    let intent = object(&[("leading", text()), ("concepts", concepts)]);
    of_frame(&[("intent", intent), ("outcome", text()), ("steps", integer())])
}

/// Reactions of the garment.
pub fn reactions() -> Value {
    of_frame(&[("index", integer()), ("name", text()), ("active", flag()), ("value", integer())])
}

/// Counters of the board.
pub fn health() -> Value {
    message(&all(
        integer,
        [
            "scans",
            "failed",
            "overruns",
            "thinned_frames",
            "thinned_contacts",
            "lost",
            "refused",
            "scan_us",
            "process_us",
        ],
    ))
}

/// Faulty taxels.
pub fn health_map() -> Value {
    let ill = object(&[("taxel", integer()), ("health", text())]);
    message(&[("whole", flag()), ("ill", list(ill))])
}

/// Time budget of the board.
pub fn budget() -> Value {
    of_frame(&all(
        integer,
        ["frames", "scan_us", "process_us", "encode_us", "send_us", "overruns", "thinned_frames"],
    ))
}

/// Temperature of the converter.
pub fn temperature() -> Value {
    message(&[("celsius", number())])
}

/// Gesture of a touch.
pub fn gestures() -> Value {
    let fields = [
        ("touch", integer()),
        ("panel", text()),
        ("class", text()),
        ("score", number()),
        ("lead", number()),
        ("observed_ms", integer()),
        ("ended", flag()),
        ("confidence", number()),
    ];
    of_frame(&fields)
}

/// State of lines and inputs.
pub fn self_test() -> Value {
    // A fault is a word, or an object that names the pin it leads to.
    let fault = object(&[("pin", integer()), ("fault", json!({}))]);
    message(&[("lines", integer()), ("inputs", integer()), ("faults", list(fault))])
}

/// Angles of the joints, as sent to the board.
pub fn posture() -> Value {
    let joint = object(&[("joint", text()), ("degrees", number())]);
    message(&[("joints", list(joint))])
}

/// A log message of the board.
pub fn log() -> Value {
    message(&all(text, ["level", "text"]))
}
