//! Messages between the program and a page, over one WebSocket at `/socket`.
//!
//! Text messages to a page are JSON objects with a `type`. Those of `taxel live --json` are the same:
//! `hello`, `health`, `health_map`, `budget`. In addition:
//!
//! | type | holds |
//! |---|---|
//! | `hello` | also `label` (the source), `palette` (`ramp`, red, green and blue of each step; `bands`, equal parts of the scale; `start`, its end at the beginning, and `ends`, least and greatest, counts; `intentions`, the colour of each), `counts_per_newton` (number or null), `low` (counts at which a contact ends), `absent` (positions without a taxel), `map`: `concepts` (`name`, `layer`) and `edges` (`from`, `to`, `weight`) |
//! | `link` | `rate` (frames/s of the board), `frames`, `lost`, `thinned`, `refused`, `restarts`, `latency_ms` (or null), `pages` |
//! | `pins` | of the last self-test: `faults` (their number), `told` (a sentence for each, or one if there are none) |
//! | `say` | a line of the log: `text`; `kind` (`onset`, `release`, `intention`, `reaction`, `gesture`, `gap` or `note`), `time_us` (or null), `said` (the text without its time) |
//! | `taxel` | the taxel under the pointer: `taxel`, `code` (raw; null until received), `frame`, `block`, `wired_row`, `wired_column` (null if it has no block) |
//! | `end` | the stream has ended; `text` says why |
//! | `none` | the last message of the type `of` is no longer valid |
//! | `player` | of a recording: `at`, `duration`, `range` (first and last), all s; `speed`, `loop`, `playing`; `seeks`, number of jumps in time |
//! | `glow` | after a jump in a recording: `time_us`, `seeks`; `taxels`, `[taxel, counts]` of the pressure just before, fading with its age |
//! | `overview` | of a recording, up to `known_us`: `duration_us`; `totals`, the greatest total of each `width_us`; `intentions`, `[at_us, leading]` at each change; `said`, `[at_us, kind, text]`; `unlisted`, number of contact lines left out |
//!
//! A binary message is an image, all numbers little-endian:
//!
//! | bytes | what |
//! |---|---|
//! | 4 | length h of the head |
//! | h | the head, JSON and spaces up to an even length: `frame`, the line of type `frame` of `taxel live --json`, but with the activations of the last moment at which the announced intention led; `samples`, `[time_us, total]` of each frame since the last image, newest last; `replaced`, images not sent because of a newer one; `missed`, samples and lines dropped because the page did not read |
//! | 2 n | pressure of the n taxels, counts, in the order of the garment |
//! | 2 n | the greatest pressure of each since the last image sent |
//!
//! The line of an image of a recording also has `at_us`, its time since the recording began, and `seeks` as
//! above; an image from before the page was opened has `past`.
//!
//! A page sends `{"hover": taxel}` (or null), and `{"tare": frames}`. If it shows a recording, it sends
//! `{"play": bool}`, `{"seek": s}`, `{"step": images}`, `{"speed": times}`, `{"loop": bool}`, `{"range":
//! [from, to]}` (s, or null), and all pages follow. Everything else is ignored, including numbers that are
//! not finite, a speed of 0 or less, and a step of 0; a time beyond the recording becomes its end.

use super::order::Order;
use super::shot::Shot;
use crate::palette;
use serde::Deserialize;
use serde_json::{Value, json};
use std::time::Duration;
use taxel::client::{Client, Event};
use taxel::fcm;
use taxel::json::{self, message, pins};
use taxel_core::format::Micros;
use taxel_core::garment::Circuit;
use taxel_core::selftest::Findings;

/// The binary message.
pub fn image(shot: &Shot, highest: &[u16], samples: &[(u64, u32)], replaced: u64, missed: u64) -> Vec<u8> {
    let samples: Vec<_> = samples.iter().map(|(time, total)| format!("[{time},{total}]")).collect();
    let (samples, line) = (samples.join(","), &shot.line);
    let mut head =
        format!(r#"{{"frame":{line},"samples":[{samples}],"replaced":{replaced},"missed":{missed}}}"#);
    if head.len() % 2 == 1 {
        head.push(' ');
    }
    let mut bytes = Vec::with_capacity(4 + head.len() + 2 * (shot.image.len() + highest.len()));
    bytes.extend_from_slice(&(head.len() as u32).to_le_bytes());
    bytes.extend_from_slice(head.as_bytes());
    bytes.extend(shot.image.iter().chain(highest).flat_map(|value| value.to_le_bytes()));
    bytes
}

/// `hello`
pub fn hello(client: &Client, label: &str, counts_per_newton: Option<f32>) -> Value {
    let mut line = message(client, &Event::Hello);
    let Some(worn) = client.worn() else { return line };
    line["label"] = json!(label);
    line["palette"] = palette::told();
    line["counts_per_newton"] = json!(counts_per_newton);
    line["low"] = json!(worn.scene.contact.low);
    line["absent"] = json!(worn.garment.absent);
    line["map"] = worn.scene.intent.as_ref().map_or(Value::Null, |intent| map(&intent.map));
    line
}

/// Encodes the cognitive map, in layers as in `taxel fcm draw`.
fn map(map: &taxel_core::intent::MapConfig) -> Value {
    let one = 10f64.powi(map.decimals.into());
    let edges: Vec<_> = map.edges.iter().filter(|edge| edge.weight != 0).collect();
    let ends: Vec<_> = edges.iter().map(|edge| (usize::from(edge.from), usize::from(edge.to))).collect();
    let layers = fcm::layers::layers(map.concepts.len(), &ends);
    let concepts = map.concepts.iter().zip(layers);
    let concepts: Vec<_> =
        concepts.map(|(name, layer)| json!({ "name": name.as_str(), "layer": layer })).collect();
    let edges = edges
        .iter()
        .map(|edge| json!({ "from": edge.from, "to": edge.to, "weight": f64::from(edge.weight) / one }));
    json!({ "concepts": concepts, "edges": edges.collect::<Vec<_>>() })
}

/// Encodes an image's line. The activations are those of the last moment at which the announced intention
/// led: a board announces it a little longer than the touch activates it, and a page shows both together.
pub fn frame(client: &Client, event: &Event) -> Value {
    let mut line = message(client, event);
    line["intent"] = json::intent(client.leading(), client.concepts(), &client.activations_of_leading());
    line
}

/// `glow`: the pressure in the second before a moment of a recording, by taxel.
pub fn glow(glow: &[u16], time: Micros, seeks: u32) -> Value {
    let taxels: Vec<_> = (0..).zip(glow).filter(|(_, counts)| **counts > 0).collect::<Vec<(u16, _)>>();
    json!({ "type": "glow", "time_us": time.0, "seeks": seeks, "taxels": taxels })
}

/// `pins`
pub fn pins(client: &Client, findings: &Findings) -> Value {
    let table = client.worn().map_or(String::new(), |worn| pins::table(&worn.garment, Some(findings)));
    json!({ "type": "pins", "faults": findings.faults.len(), "told": table.lines().collect::<Vec<_>>() })
}

/// `taxel`
pub fn taxel(taxel: u16, circuit: Option<&Circuit>, code: Option<(u32, u16)>) -> Value {
    let wired = circuit.and_then(|circuit| circuit.wired(usize::from(taxel)));
    json!({
        "type": "taxel",
        "taxel": taxel,
        "frame": code.map(|(frame, _)| frame),
        "code": code.map(|(_, code)| code),
        "block": wired.map(|w| w.0),
        "wired_row": wired.map(|w| w.1),
        "wired_column": wired.map(|w| w.2),
    })
}

/// `link`
pub fn link(client: &Client, rate: f64, latency: Option<Duration>, pages: usize) -> Value {
    let counts = client.counts();
    json!({
        "type": "link",
        "rate": rate,
        "frames": counts.frames,
        "lost": counts.lost,
        "thinned": counts.thinned,
        "refused": counts.refused(),
        "restarts": counts.restarts,
        "latency_ms": latency.map(|latency| latency.as_secs_f64() * 1e3),
        "pages": pages,
    })
}

/// A request of a page.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PageWish {
    /// The taxel under the pointer.
    Hover(Option<u16>),
    /// A tare over this many frames.
    Tare(u16),
    /// An order to the player of a recording.
    #[serde(untagged)]
    Player(Order),
}

/// Parses a message of a page; none if it is unknown.
pub fn wish(text: &str) -> Option<PageWish> {
    let wish: PageWish = serde_json::from_str(text).ok()?;
    let known = match &wish {
        PageWish::Hover(_) => true,
        PageWish::Tare(frames) => (1..=4096).contains(frames),
        PageWish::Player(order) => order.is_sound(),
    };
    known.then_some(wish)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_known_is_a_wish() {
        assert_eq!(wish(r#"{"hover": 7}"#), Some(PageWish::Hover(Some(7))));
        assert_eq!(wish(r#"{"hover": null}"#), Some(PageWish::Hover(None)));
        assert_eq!(wish(r#"{"tare": 32}"#), Some(PageWish::Tare(32)));
        assert_eq!(wish(r#"{"seek": 2.5}"#), Some(PageWish::Player(Order::Seek(2.5))));
        assert_eq!(wish(r#"{"range": null}"#), Some(PageWish::Player(Order::Range(None))));
        assert_eq!(wish(r#"{"range": [1, 2]}"#), Some(PageWish::Player(Order::Range(Some([1.0, 2.0])))));
        assert_eq!(wish(r#"{"step": -1}"#), Some(PageWish::Player(Order::Step(-1))));
        for nonsense in [
            r#"{"seek": 1e999}"#,
            r#"{"seek": NaN}"#,
            r#"{"seek": null}"#,
            r#"{"speed": 0}"#,
            r#"{"speed": -2}"#,
            r#"{"range": [1]}"#,
            r#"{"range": [1, "x"]}"#,
            r#"{"step": 0}"#,
            r#"{"step": 5000}"#,
            r#"{"step": -2147483648}"#,
            r#"{"play": 1}"#,
        ] {
            assert_eq!(wish(nonsense), None, "{nonsense}");
        }
        for nonsense in ["", "{}", "[]", r#"{"hover": -1}"#, r#"{"hover": 1e9}"#, r#"{"tare": 0}"#, "7"] {
            assert_eq!(wish(nonsense), None, "{nonsense}");
        }
    }

    #[test]
    fn images_lie_at_even_places() {
        for line in ["{}", "[7]"] {
            let shot = Shot { line: line.into(), image: [513, 2].into(), time_us: 5, total: 6 };
            let bytes = image(&shot, &[3, 4], &[(5, 6)], 1, 2);
            let end = bytes.len() - 8;
            assert_eq!(end % 2, 0);
            assert_eq!(bytes[end..], [1, 2, 2, 0, 3, 0, 4, 0]);
            let head: Value = serde_json::from_slice(&bytes[4..end]).unwrap();
            assert_eq!(head["samples"], json!([[5, 6]]));
            assert_eq!((&head["replaced"], &head["missed"]), (&json!(1), &json!(2)));
        }
    }
}
