//! What a board reports, as messages, read again by their definitions.

use super::definitions::Definitions;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use taxel::body::{self, DVec3, Pose};
use taxel::client::{Client, Event, SIMULATED};
use taxel::json::message;
use taxel::ros2::messages::{self, DiagnosticState};
use taxel::ros2::{own, schemas};
use taxel::session::Session;
use taxel_core::format::name;
use taxel_core::garment::{Area, Garment, Layout};
use taxel_core::react::Reaction;
use taxel_core::wire::{Health, ReactionReport};

/// Time of the messages, us.
const US: u64 = 1_700_000_000_000_123;
const STAMP: [u64; 2] = [1_700_000_000, 123_000];
/// Counts per newton.
const SCALE: f64 = 1000.0;

fn stamp() -> Value {
    json!({ "sec": STAMP[0], "nanosec": STAMP[1] })
}

/// Fields of `Contact.msg` that are keys of a contact's JSON.
const SAME: [&str; 35] = [
    "id",
    "panel",
    "panel_name",
    "region",
    "link",
    "total",
    "peak",
    "peak_row",
    "peak_column",
    "top",
    "bottom",
    "left",
    "right",
    "area",
    "perimeter",
    "edge",
    "column",
    "row",
    "azimuth_rad",
    "anisotropy",
    "breadth_mm",
    "nmi",
    "nmi_peak",
    "nmi_s2",
    "shape",
    "confidence",
    "moved_columns",
    "moved_rows",
    "columns_per_s",
    "rows_per_s",
    "slip",
    "unsure",
    "duration_ms",
    "peak_total",
    "peak_breadth_mm",
];

/// Fails unless a contact says what its JSON says.
fn same_contact(read: &Value, line: &Value) {
    for key in SAME {
        assert_eq!(read[key], line[key], "{key}");
    }
    let metres = |value: &Value, mm: &str| {
        let (own, reported) = (value.as_f64().unwrap(), line[mm].as_f64().unwrap() / 1000.0);
        assert!((own - reported).abs() <= 1e-12, "{mm}: {own} m");
    };
    metres(&read["position"]["x"], "x_mm");
    metres(&read["position"]["y"], "y_mm");
    assert_eq!([&read["force"], &json!(line["total"].as_f64().unwrap() / SCALE)], [&line["force_n"]; 2]);
    let phase = ["onset", "held", "released"][read["phase"].as_u64().unwrap() as usize];
    assert_eq!(phase, line["phase"]);
    assert_eq!(read["contact"], json!(phase != "released"));
    let frame = format!("tactile/{}", line["panel_name"].as_str().unwrap().replace(' ', "_"));
    assert_eq!(read["header"], json!({ "stamp": stamp(), "frame_id": frame }));
    // No body is named.
    assert_eq!([&read["body_link"], &read["link_normal"]["x"]], [&json!(""), &Value::Null]);
}

/// Fails unless an event's message says what its JSON says; returns the name of its type.
fn same(all: &Definitions, client: &Client, event: &Event) -> Option<&'static str> {
    let line = message(client, event);
    match event {
        Event::Contacts { frame, dropped, released, .. } => {
            let bytes = own::contacts("", US, client, (*frame, *dropped), released, None);
            let read = all.read("Contacts", &bytes);
            for list in ["contacts", "released"] {
                let (read, line) = (read[list].as_array().unwrap(), line[list].as_array().unwrap());
                assert_eq!(read.len(), line.len());
                read.iter().zip(line).for_each(|(read, line)| same_contact(read, line));
            }
            let keys = ["frame", "dropped", "force_basis"];
            assert_eq!(keys.map(|key| &read[key]), keys.map(|key| &line[key]));
            Some("Contacts")
        }
        Event::Symbols(list) => {
            let read = all.read("Symbols", &own::symbols(US, client, list));
            for (read, line) in
                read["events"].as_array().unwrap().iter().zip(line["events"].as_array().unwrap())
            {
                let words = &line["words"];
                for (field, reported) in
                    [("strength", "strength"), ("extent", "extent"), ("span", "span"), ("shape", "shape")]
                {
                    assert_eq!(read[field], words[reported]);
                }
                assert_eq!(read["duration_ms"], line["duration_ms"]);
                assert_eq!([&read["contact"], &read["peak_total"]], [&line["contact"], &line["peak_total"]]);
            }
            for (read, line) in
                read["regions"].as_array().unwrap().iter().zip(line["regions"].as_array().unwrap())
            {
                for key in ["region", "contacts", "total", "peak", "moving", "since_us"] {
                    assert_eq!(read[key], line[key], "{key}");
                }
            }
            Some("Symbols")
        }
        Event::Intent(report) => {
            let read = all.read("Intent", &own::intent(US, client, report));
            assert_eq!([&read["leading"], &read["outcome"]], [&line["leading"], &line["outcome"]]);
            let concepts =
                read["concepts"].as_array().unwrap().iter().zip(read["activations"].as_array().unwrap());
            let reported = &line["concepts"];
            assert!(concepts.clone().count() > 3);
            concepts.for_each(|(name, value)| assert_eq!(*value, reported[name.as_str().unwrap()]));
            Some("Intent")
        }
        Event::Health(health) => {
            let read = all.read("Health", &own::health(US, client, health));
            for key in [
                "scans",
                "failed",
                "overruns",
                "thinned_frames",
                "thinned_contacts",
                "lost",
                "refused",
                "scan_us",
                "process_us",
            ] {
                assert_eq!(read[key], line[key], "{key}");
            }
            let reported = messages::diagnostics("", US, "x", DiagnosticState::Reports(health, 3));
            let read = Definitions::of_text("D", schemas::DIAGNOSTICS).read("D", &reported);
            assert_eq!(read["status"][0]["values"][9], json!({ "key": "faulty_taxels", "value": "3" }));
            Some("Health")
        }
        Event::Frame { .. } => {
            same_panels(client);
            Some("Frame")
        }
        _ => None,
    }
}

/// Fails unless the standard messages of an image are as their definitions say.
fn same_panels(client: &Client) {
    let Some((_, image)) = client.image() else { return };
    let layout = client.layout().unwrap();
    for area in layout.areas() {
        let start = usize::from(area.base);
        let values = &image[start..start + usize::from(area.rows) * usize::from(area.columns)];
        let read =
            Definitions::of_text("I", schemas::IMAGE).read("I", &messages::image("", US, area, values));
        assert_eq!(read["data"].as_array().unwrap().len(), 2 * values.len());
        let read = Definitions::of_text("P", schemas::POINT_CLOUD)
            .read("P", &messages::points("", US, area, values));
        assert_eq!(read["data"].as_array().unwrap().len(), 16 * values.len());
        same_wrench(area, values);
    }
    let read = Definitions::of_text("F", schemas::FRAMES).read("F", &messages::frames("", US, layout, None));
    assert_eq!(read["transforms"].as_array().unwrap().len(), layout.areas().len());
}

/// Fails unless force and moment of a panel are those of its points.
fn same_wrench(area: &Area, values: &[u16]) {
    let reported = messages::wrench("", US, area, values, SCALE);
    let read = Definitions::of_text("W", schemas::WRENCH).read("W", &reported);
    let mut want = [DVec3::ZERO; 2];
    for (index, value) in (0u16..).zip(values) {
        let [x, y] = [index % area.columns, index / area.columns].map(f64::from);
        let at = DVec3::new(x * f64::from(area.pitch_um[0]), y * f64::from(area.pitch_um[1]), 0.0) * 1e-6;
        // Into the robot.
        let force = DVec3::Z * f64::from(*value) / SCALE;
        want = [want[0] + force, want[1] + at.cross(force)];
    }
    for (part, want) in ["force", "torque"].into_iter().zip(want) {
        for (axis, want) in ["x", "y", "z"].into_iter().zip(want.to_array()) {
            let own = read["wrench"][part][axis].as_f64().unwrap();
            assert!((own - want).abs() < 1e-9, "{part}.{axis}: {own}, not {want}");
        }
    }
}

#[test]
fn frames_of_panels_lie_on_the_body() {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, 2048, 4095).unwrap();
    let surface = body::read("reference").unwrap().surface(&garment, &layout).unwrap();
    let reported = messages::frames("", US, &layout, Some(&surface));
    let read = Definitions::of_text("F", schemas::FRAMES).read("F", &reported);
    let transforms = read["transforms"].as_array().unwrap();
    assert_eq!(transforms.len(), layout.areas().len());
    for ((panel, area), reported) in (0..).zip(layout.areas()).zip(transforms) {
        let parts = |key: &str, names: &[&str]| -> Vec<f64> {
            names.iter().map(|name| reported["transform"][key][name].as_f64().unwrap()).collect()
        };
        let at: [f64; 3] = parts("translation", &["x", "y", "z"]).try_into().unwrap();
        let turn: [f64; 4] = parts("rotation", &["x", "y", "z", "w"]).try_into().unwrap();
        let pose = Pose::from_arrays(at, turn);
        // The middle of the flat panel is that on the body, and z goes into the robot there.
        let [x, y] = [area.columns, area.rows].map(|count| f64::from(count - 1) / 2.0);
        let pitch = area.pitch_um.map(|um| f64::from(um) * 1e-6);
        let middle = surface.at(&layout, panel, x, y).unwrap();
        assert_eq!(reported["header"]["frame_id"], json!(surface.links()[middle.link]));
        assert!(
            pose.point(DVec3::new(x * pitch[0], y * pitch[1], 0.0)).distance(middle.at) < 1e-9,
            "{reported}"
        );
        assert!(pose.direction(DVec3::NEG_Z).distance(middle.normal) < 1e-3, "{reported}");
        // Taxels near the middle lie where the frame says: the body bends away by less than half a millimetre.
        for (dx, dy) in [(0.5, 0.0), (0.0, 0.5), (-0.5, -0.5)] {
            let near = surface.at(&layout, panel, x + dx, y + dy).unwrap();
            let flat = pose.point(DVec3::new((x + dx) * pitch[0], (y + dy) * pitch[1], 0.0));
            assert!(flat.distance(near.at) < 5e-4, "{dx}, {dy}: {flat} {}", near.at);
        }
    }
}

#[test]
fn every_message_is_as_its_definition_and_says_what_json_says() {
    let all = Definitions::of_package();
    let mut seen = BTreeSet::new();
    let mut session = Session::open("sim:five").unwrap();
    while let Some(event) = session.wait().unwrap() {
        seen.extend(same(&all, session.client(), &event));
    }
    assert_eq!(Vec::from_iter(seen), ["Contacts", "Frame", "Health", "Intent", "Symbols"]);
    let reaction = Reaction { index: 2, name: name("flinch"), active: true, value: -7 };
    let report = ReactionReport { frame: 5, time: Default::default(), reaction };
    let read = all.read("Reaction", &own::reaction(US, &report));
    let header = json!({ "stamp": stamp(), "frame_id": "" });
    let reported =
        json!({ "header": header, "frame": 5, "index": 2, "name": "flinch", "active": true, "value": -7 });
    assert_eq!(read, reported);
}

#[test]
fn small_messages_are_as_their_definitions() {
    let text = Definitions::of_text("S", "string data");
    assert_eq!(text.read("S", &messages::text("a")), json!({ "data": "a" }));
    let time = "builtin_interfaces/Time clock\n====\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec";
    assert_eq!(Definitions::of_text("C", time).read("C", &messages::clock(US)), json!({ "clock": stamp() }));
    let joints = "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n\
                  ====\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n\
                  ====\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec";
    let read =
        Definitions::of_text("J", joints).read("J", &messages::joints((4, 5), &["a", "bc"], &[1.0, -2.0]));
    assert_eq!(read["header"]["stamp"], json!({ "sec": 4, "nanosec": 5 }));
    assert_eq!([&read["name"], &read["position"]], [&json!(["a", "bc"]), &json!([1.0, -2.0])]);
    let lost = messages::diagnostics("", US, "taxel-fw", DiagnosticState::Lost("usb is gone"));
    let read = Definitions::of_text("D", schemas::DIAGNOSTICS).read("D", &lost);
    assert_eq!(
        [&read["status"][0]["level"], &read["status"][0]["message"]],
        [&json!(3), &json!("usb is gone")]
    );
    let health = Health::default();
    let simulated = messages::diagnostics("", US, SIMULATED, DiagnosticState::Reports(&health, 0));
    let read = Definitions::of_text("D", schemas::DIAGNOSTICS).read("D", &simulated);
    assert_eq!(
        [&read["status"][0]["message"], &read["status"][0]["hardware_id"]],
        [&json!("simulated: all is well"), &json!(SIMULATED)]
    );
}
