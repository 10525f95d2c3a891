//! Messages between the program and a page, over one WebSocket at `socket` beside the page.
//!
//! Text messages to a page are JSON objects with a `type`: the lines `health`, `health_map`, `budget` and `lost` of
//! `taxel live --json`, those of `lines.rs` beside this, and `body` and `poses` of `on_robot/lines.rs`.
//!
//! A binary message is an image, all numbers little-endian:
//!
//! | bytes | what |
//! |---|---|
//! | 4 | length h of the head |
//! | h | the head, JSON and spaces up to an even length: `ImageHead` of `lines.rs` |
//! | 2 n | pressure of the n taxels, counts, in the order of the garment |
//! | 2 n | the greatest pressure of each since the last image sent |
//!
//! A page sends `{"hover": taxel}` (or null), `{"tare": frames}`, and `{"why": {"of": concept, "concepts":
//! activations}}`, which is answered by `why`. If its board is simulated, it sends `{"press": ..}` ([`FingerRequest`]),
//! `{"release": finger}`, `{"script": name}` and `{"hand": "again"}` or `"clear"`, and is sent `hand`. Where it is sent
//! `setup`, it sends `{"limits": ..}` ([`SceneLimits`]) and `{"setup": "undo"}` or `"save"`. If it shows a
//! recording, it sends
//! `{"play": bool}`, `{"seek": s}`, `{"step": images}`, `{"speed": times}`, `{"loop": bool}`, `{"range":
//! [from, to]}` (s, or null), and all pages follow. Everything else is ignored, including numbers that are
//! not finite, a speed of 0 or less, and a step of 0; a time beyond the recording becomes its end.

use super::limits::SceneLimits;
use super::lines::{
    GlowLine, LinkLine, PageConcept, PageEdge, PageFrame, PageHello, PageMap, PathShare, PinsLine, TaxelLine,
    WhyLine,
};
use super::order::Order;
use super::shot::Shot;
use crate::palette;
use crate::watch::Felt;
use crate::watch::shape::shape;
use serde::Deserialize;
use std::time::Duration;
use taxel::client::{Client, Event};
use taxel::fcm::map::MapFile;
use taxel::fcm::{layers, why as causes};
use taxel::json::lines::{FrameLine, JsonLine};
use taxel::json::{self, MeaningOfTouch, pins};
use taxel_core::format::{Micros, Name, Q15};
use taxel_core::garment::Circuit;
use taxel_core::intent::{Edge, MapConfig};
use taxel_core::selftest::Findings;

/// Paths listed in `why`.
const PATHS: usize = 24;

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

/// `hello`; none before the board has sent its garment.
pub fn hello<'a>(client: &'a Client, label: &'a str) -> Option<PageHello<'a>> {
    let (Some(JsonLine::Hello(line)), Some(description)) =
        (json::line(client, &Event::Hello), client.description())
    else {
        return None;
    };
    Some(PageHello {
        line,
        label,
        palette: palette::for_page(),
        counts_per_newton: client.counts_per_newton(),
        force_basis: client.force_basis(),
        low: description.scene.contact.low,
        absent: &description.garment.absent,
        map: description.scene.intent.as_ref().map(|intent| map(&intent.map)),
    })
}

/// The cognitive map, in layers.
fn map(map: &MapConfig) -> PageMap<'_> {
    let one = 10f64.powi(map.decimals.into());
    let concepts = map.concepts.iter().zip(layers::of_config(map));
    let concept = |(name, (layer, role))| PageConcept { name: Name::as_str(name), layer, role };
    let edge = |edge: &Edge| PageEdge { from: edge.from, to: edge.to, weight: f64::from(edge.weight) / one };
    PageMap {
        concepts: concepts.map(concept).collect(),
        edges: map.edges.iter().filter(|edge| edge.weight != 0).map(edge).collect(),
    }
}

/// `why`: causes of a concept's activation, or of the strongest intention's; none if it has no cause, or the map
/// does not know it.
pub fn why(map: &MapFile, of: Option<&str>, activations: &[f64]) -> Option<WhyLine> {
    let activations: Vec<_> = activations.iter().map(|value| Q15((value * 32768.0).round() as i32)).collect();
    let explained = causes::explain_state(map, &activations, of).ok()?;
    let (shares, concept) = (&explained.shares, usize::from(explained.why.concept));
    let name = |at: usize| map.concept[at].name.clone();
    let share = |units: i64| units as f64 / 32768.0;
    let others: i64 = shares.paths.iter().skip(PATHS).map(|path| path.share).sum();
    let others = (others != 0).then(|| ("further paths".to_string(), share(others)));
    let rest = shares.rest.iter().map(|(reason, units)| (reason.clone(), share(*units)));
    Some(WhyLine {
        concept: name(concept),
        activation: explained.map.value(explained.run.state[concept]),
        inputs: shares.inputs().into_iter().map(|(at, units)| (name(at), share(units))).collect(),
        paths: shares
            .paths
            .iter()
            .take(PATHS)
            .map(|path| PathShare {
                concepts: path.concepts.iter().copied().map(name).collect(),
                share: share(path.share),
            })
            .collect(),
        rest: rest.chain(others).collect(),
        sum: share(shares.sum()),
    })
}

/// The line of an image; none of another event. The activations are those of the last moment at which the
/// announced intention led: a board announces it a little longer than the touch activates it, and a page
/// shows both together.
pub fn frame<'a>(client: &'a Client, event: &'a Event) -> Option<PageFrame<'a>> {
    let Some(JsonLine::Frame(line)) = json::line(client, event) else { return None };
    let intent = MeaningOfTouch::of(client.leading(), client.concepts(), &client.activations_of_leading());
    Some(PageFrame {
        line: FrameLine { intent, ..line },
        felt: Felt::of(client),
        shapes: client.contacts().iter().map(|placed| shape(client, placed)).collect(),
        at_us: None,
        seeks: None,
        pressing: None,
        past: None,
    })
}

/// `glow`: the pressure in the second before a moment of a recording, by taxel.
pub fn glow(glow: &[u16], time: Micros, seeks: u32) -> GlowLine {
    let taxels = (0..).zip(glow.iter().copied()).filter(|(_, counts)| *counts > 0).collect();
    GlowLine { time_us: time.0, seeks, taxels }
}

/// `pins`
pub fn pins(client: &Client, findings: &Findings) -> PinsLine {
    let text = client
        .description()
        .map_or(String::new(), |description| pins::table(&description.garment, Some(findings)));
    PinsLine { faults: findings.faults.len(), table: text.lines().map(String::from).collect() }
}

/// `taxel`
pub fn taxel(taxel: u16, circuit: Option<&Circuit>, code: Option<(u32, u16)>) -> TaxelLine {
    let wired = circuit.and_then(|circuit| circuit.wired(usize::from(taxel)));
    TaxelLine {
        taxel,
        frame: code.map(|(frame, _)| frame),
        code: code.map(|(_, code)| code),
        block: wired.map(|w| w.0),
        wired_row: wired.map(|w| w.1),
        wired_column: wired.map(|w| w.2),
    }
}

/// `link`
pub fn link(client: &Client, rate: f64, latency: Option<Duration>, pages: usize) -> LinkLine {
    let counts = client.counts();
    LinkLine {
        rate,
        frames: counts.frames,
        lost: counts.lost,
        thinned: counts.thinned,
        refused: counts.refused(),
        restarts: counts.restarts,
        latency_ms: latency.map(|latency| latency.as_secs_f64() * 1e3),
        pages,
    }
}

/// Fingers of a page: two hands.
pub const FINGERS: u8 = 10;

/// A request of a page.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum PageRequest {
    /// The taxel under the pointer.
    Hover(Option<u16>),
    /// A tare over this many frames.
    Tare(u16),
    /// Causes of an activation.
    Why {
        /// The concept; null for the strongest intention.
        of: Option<String>,
        /// Activation of each concept of the map, -1 to 1, in the order of the map.
        concepts: Vec<f64>,
    },
    /// A finger presses the garment of a simulated board, or moves on it.
    Press(FingerRequest),
    /// A finger lifts, 0 to 9.
    Release(u8),
    /// A script of touches is played once.
    Script(String),
    /// Order to play again what was pressed, or to forget it.
    Hand(HandOrder),
    /// Limits and filter for the board's scene.
    Limits(SceneLimits),
    /// Order about what was set.
    Setup(SettingsOrder),
    /// An order to the player of a recording.
    #[serde(untagged)]
    Player(Order),
}

impl PageRequest {
    /// True if it changes something on the board or its garment.
    pub fn changes(&self) -> bool {
        match self {
            PageRequest::Hover(_) | PageRequest::Why { .. } | PageRequest::Player(_) => false,
            PageRequest::Tare(_) | PageRequest::Limits(_) | PageRequest::Setup(_) => true,
            PageRequest::Press(_) | PageRequest::Release(_) => true,
            PageRequest::Script(_) | PageRequest::Hand(_) => true,
        }
    }
}

/// Press of a finger.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FingerRequest {
    /// Number of the finger, 0 to 9.
    pub finger: u8,
    /// Name of the tool.
    pub tool: String,
    /// Index of the panel.
    pub panel: u8,
    /// Centre, taxels of the panel: along the columns, along the rows.
    pub at: [f64; 2],
    /// Force, N: 0 to 200.
    pub force_n: f64,
    /// Direction of the tool's length, degrees from +x towards +y.
    #[serde(default)]
    pub angle_deg: f64,
}

/// Order about what was pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum HandOrder {
    /// Order to play it again.
    Again,
    /// Order to forget it.
    Clear,
}

/// Order about what was set on the board.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum SettingsOrder {
    /// Order to take back the last step.
    Undo,
    /// Order to save the settings on the board.
    Save,
}

/// Parses a message of a page; none if it is unknown.
pub fn request(text: &str) -> Option<PageRequest> {
    let request: PageRequest = serde_json::from_str(text).ok()?;
    let known = match &request {
        PageRequest::Hover(_) => true,
        PageRequest::Tare(frames) => (1..=4096).contains(frames),
        PageRequest::Press(FingerRequest { finger, .. }) | PageRequest::Release(finger) => *finger < FINGERS,
        PageRequest::Script(_) | PageRequest::Hand(_) | PageRequest::Setup(_) => true,
        PageRequest::Limits(limits) => limits.is_sound(),
        PageRequest::Why { concepts, .. } => concepts.iter().all(|value| (-1.0..=1.0).contains(value)),
        PageRequest::Player(order) => order.is_sound(),
    };
    known.then_some(request)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};
    use taxel::fcm::{self, decimal::Decimal};

    #[test]
    fn only_what_is_known_is_a_request() {
        assert_eq!(request(r#"{"hover": 7}"#), Some(PageRequest::Hover(Some(7))));
        assert_eq!(request(r#"{"hover": null}"#), Some(PageRequest::Hover(None)));
        assert_eq!(request(r#"{"tare": 32}"#), Some(PageRequest::Tare(32)));
        assert_eq!(request(r#"{"seek": 2.5}"#), Some(PageRequest::Player(Order::Seek(2.5))));
        assert_eq!(request(r#"{"range": null}"#), Some(PageRequest::Player(Order::Range(None))));
        assert_eq!(
            request(r#"{"range": [1, 2]}"#),
            Some(PageRequest::Player(Order::Range(Some([1.0, 2.0]))))
        );
        assert_eq!(request(r#"{"step": -1}"#), Some(PageRequest::Player(Order::Step(-1))));
        let of = Some("kindness".into());
        let why = PageRequest::Why { of, concepts: vec![0.5, -1.0] };
        assert_eq!(request(r#"{"why": {"of": "kindness", "concepts": [0.5, -1]}}"#), Some(why));
        for nonsense in [
            r#"{"why": {"of": null, "concepts": [2]}}"#,
            r#"{"why": {"of": 7, "concepts": []}}"#,
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
            assert_eq!(request(nonsense), None, "{nonsense}");
        }
        let press = r#"{"press": {"finger": 0, "tool": "palm", "panel": 1, "at": [7.5, 11], "force_n": 8}}"#;
        let Some(PageRequest::Press(finger)) = request(press) else { panic!("{press}") };
        assert_eq!((finger.tool.as_str(), finger.at, finger.angle_deg), ("palm", [7.5, 11.0], 0.0));
        assert_eq!(request(&press.replace("0,", "10,")), None);
        assert_eq!(request(r#"{"release": 9}"#), Some(PageRequest::Release(9)));
        assert_eq!(request(r#"{"release": 10}"#), None);
        assert_eq!(request(r#"{"hand": "again"}"#), Some(PageRequest::Hand(HandOrder::Again)));
        assert_eq!(request(r#"{"script": "pat"}"#), Some(PageRequest::Script("pat".into())));
        let limits = r#"{"limits": {"floor": 24, "low": 30, "high": 80, "min_area": 2, "filter": "median"}}"#;
        assert!(matches!(request(limits), Some(PageRequest::Limits(SceneLimits { high: 80, .. }))));
        assert_eq!(request(&limits.replace("80", "20")), None);
        assert_eq!(request(&limits.replace("median", "none")), None);
        assert_eq!(request(r#"{"setup": "undo"}"#), Some(PageRequest::Setup(SettingsOrder::Undo)));
        for nonsense in ["", "{}", "[]", r#"{"hover": -1}"#, r#"{"hover": 1e9}"#, r#"{"tare": 0}"#, "7"] {
            assert_eq!(request(nonsense), None, "{nonsense}");
        }
    }

    #[test]
    fn why_adds_up_and_names_what_warmth_causes() {
        let map = fcm::load::map("tactile").unwrap();
        let inputs = [("press", 0.1), ("shape", -0.5), ("goodwill", 1.0)];
        let inputs = inputs.map(|(name, value)| (name.to_string(), Decimal::from_f64(value).unwrap()));
        let run = fcm::why::explain(&map, &inputs, None).unwrap();
        let activations: Vec<f64> =
            run.run.state[..map.concept.len()].iter().map(|x| run.map.value(*x)).collect();
        let line = why(&map, None, &activations).unwrap();
        assert_eq!((line.concept.as_str(), line.inputs[0].0.as_str()), ("kindness", "goodwill"));
        let rest: f64 = line.rest.iter().map(|(_, share)| share).sum();
        let paths: f64 = line.paths.iter().map(|path| path.share).sum();
        assert!((paths + rest - line.sum).abs() < 1e-9 && line.activation > 0.9, "{line:?}");
        assert!(why(&map, Some("press"), &activations).is_none(), "an input has no cause");
        assert!(why(&map, Some("nothing"), &[]).is_none());
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
