//! What presses on the robot, as messages: what the board's JSON says, by the definitions.

use super::definitions::Definitions;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;
use taxel::body::{self, Surface};
use taxel::client::{Client, Event};
use taxel::files::calibrate::ForceScale;
use taxel::json::message;
use taxel::ros2::{messages, own, pressing, schemas};
use taxel::session::{Session, setting};
use taxel::source::{self, SourceOptions};
use taxel_core::wire::{PressingReport, RegionsReport};

const US: u64 = 1_700_000_000_000_123;
/// A region that holds all of the torso.
const REGION: &str = "\n[[regions]]\nname = \"torso\"\nlink = \"torso\"\n\
                      within.box = { from = [-1, -1, -1], to = [1, 1, 1] }\n";

/// Fails unless a point or vector has these parts.
fn same(read: &Value, want: &Value, scale: f64) {
    for (axis, part) in ["x", "y", "z"].into_iter().zip(want.as_array().unwrap()) {
        let (own, reported) = (read[axis].as_f64().unwrap(), part.as_f64().unwrap() / scale);
        assert!((own - reported).abs() <= 1e-9 * reported.abs().max(1e-3), "{read} is not {want} / {scale}");
    }
}

/// Fails unless a message says of a contact or a link what its line leaves uncertain.
fn same_uncertain(read: &Value, line: &Value, scale: Option<f64>) {
    let of = |key: &str| line["uncertain"][key].as_f64().unwrap_or(0.0);
    let newtons = |key| scale.map(|scale| of(key) / scale);
    let (less, more) = (newtons("less_counts"), newtons("more_counts"));
    let reported = [Some(of("saturated")), Some(of("faulty")), less, more, Some(of("off_m"))];
    let own = ["saturated", "faulty", "less_n", "more_n", "off_m"];
    assert_eq!(own.map(|key| read["uncertain"][key].as_f64()), reported, "{line}");
}

/// Fails unless the message of the surface's regions says what their line says.
fn same_regions(all: &Definitions, client: &Client, report: &RegionsReport) {
    const PHASES: [&str; 5] = ["free", "onset", "held", "moving", "released"];
    const WAYS: [&str; 7] = ["none", "forward", "back", "left", "right", "up", "down"];
    let line = message(client, &Event::Regions(Box::new(report.clone())));
    let read = all.read("BodyRegions", &pressing::regions(US, client, report));
    assert_eq!(read["frame"], line["frame"]);
    let [own, reported] = [&read, &line].map(|of| of["regions"].as_array().unwrap());
    assert_eq!(own.len(), reported.len());
    for (own, reported) in own.iter().zip(reported) {
        let named = |key: &str, names: &[&str]| json!(names[own[key].as_u64().unwrap() as usize]);
        assert_eq!(
            [named("phase", &PHASES), named("way", &WAYS)],
            [&reported["phase"], &reported["way"]].map(Value::clone)
        );
        for (key, other) in [
            ("region", "region"),
            ("contacts", "contacts"),
            ("strength", "strength"),
            ("extent", "extent"),
            ("shape", "shape"),
        ] {
            assert_eq!(own[key], reported[other]);
        }
        assert_eq!(own["since_us"], reported["since_us"]);
    }
}

/// Fails unless a report's message and its links' forces say what its line says.
fn same_report(all: &Definitions, client: &Client, report: &PressingReport) {
    let scale = client.counts_per_newton();
    let line = message(client, &Event::Pressing(Box::new(report.clone())));
    let read = all.read("Pressing", &pressing::pressing(US, report, "base_link", client.newtons()));
    assert_eq!([&read["header"]["frame_id"], &read["frame"]], [&json!("base_link"), &line["frame"]]);
    assert_eq!(read["force_basis"].as_str().unwrap(), line["force_basis"].as_str().unwrap_or(""));
    assert_eq!(read["pose_age_us"].as_f64(), line["pose_age_us"].as_f64());
    assert_eq!(read["pose_error_m"], line["pose_error_m"]);
    // Newtons; none while nobody knows the counts per newton.
    let same_force = |read: &Value, line: &Value| match scale {
        Some(_) => same(read, line, 1.0),
        None => assert!(read["x"].is_null() && line.is_null(), "{read}, {line}"),
    };
    let [contacts, links] = ["contacts", "links"].map(|key| {
        let (own, reported) = (read[key].as_array().unwrap(), line[key].as_array().unwrap());
        assert_eq!(own.len(), reported.len());
        own.iter().cloned().zip(reported.iter().cloned()).collect::<Vec<_>>()
    });
    for (read, line) in contacts {
        assert_eq!([&read["id"], &read["link"]], [&line["id"], &line["link"]]);
        same(&read["position"], &line["at_m"], 1.0);
        same(&read["normal"], &line["normal"], 1.0);
        same_force(&read["force"], &line["force_n"]);
        same_uncertain(&read, &line, scale);
        if line["base"].is_null() {
            assert_eq!([&read["base_position"]["x"], &read["base_force"]["z"]], [&Value::Null; 2]);
        } else {
            same(&read["base_position"], &line["base"]["at_m"], 1.0);
            same(&read["base_normal"], &line["base"]["normal"], 1.0);
            same_force(&read["base_force"], &line["base"]["force_n"]);
        }
    }
    for ((read, line), wrench) in links.iter().zip(&report.links) {
        assert_eq!(read["link"], line["link"]);
        same_uncertain(read, line, scale);
        same(&read["center"], &line["center_m"], 1.0);
        assert_eq!(read["pressed_n"].as_f64(), line["pressed_n"].as_f64());
        assert_eq!(read["pressed_counts"], line["pressed_counts"]);
        same_force(&read["force"], &line["force_n"]);
        same_force(&read["moment"], &line["moment_nm"]);
        let reported = pressing::wrench(US, &wrench.name, Some(wrench), scale);
        let reported = Definitions::of_text("W", schemas::WRENCH).read("W", &reported);
        assert_eq!(reported["header"]["frame_id"], line["link"]);
        same(&reported["wrench"]["force"], &line["force_counts"], scale.unwrap_or(1.0));
        same(&reported["wrench"]["torque"], &line["moment_counts_m"], scale.unwrap_or(1.0));
    }
}

/// Fails unless the contacts of a list lie where the board says that they do.
fn same_contacts(all: &Definitions, session: &Session, surface: &Surface, report: &PressingReport) -> usize {
    let client = session.client();
    let read = all.read("Contacts", &own::contacts("", US, client, (0, 0), &[], Some(surface)));
    let mut seen = 0;
    for contact in read["contacts"].as_array().unwrap() {
        let Some(landed) = report.contacts.iter().find(|landed| contact["id"] == json!(landed.id)) else {
            continue;
        };
        assert_eq!(contact["body_link"], json!(surface.links()[usize::from(landed.spot.link)]));
        for (index, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let part = |field: &str| contact[field][axis].as_f64().unwrap();
            let normal = part("link_normal");
            assert!((part("link_position") - f64::from(landed.spot.at[index]) * 1e-6).abs() < 1e-4);
            assert!((normal - f64::from(landed.spot.normal[index]) / 16_384.0).abs() < 1e-3);
            assert!((part("link_force") + normal * contact["force"].as_f64().unwrap()).abs() < 1e-9);
        }
        seen += 1;
    }
    seen
}

/// Fails unless the points of each panel are the places of its taxels.
fn same_points(client: &Client, surface: &Surface) {
    let Some((_, image)) = client.image() else { return };
    for area in client.layout().unwrap().areas() {
        let start = usize::from(area.base);
        let values = &image[start..start + usize::from(area.rows) * usize::from(area.columns)];
        let reported = pressing::points("", US, area, Some(surface), values);
        let read = Definitions::of_text("P", schemas::POINT_CLOUD).read("P", &reported);
        let link = surface.places()[start].unwrap().link;
        assert_eq!(read["header"]["frame_id"], json!(surface.links()[link]));
        assert_eq!([&read["point_step"], &read["is_dense"]], [&json!(28), &json!(true)]);
        let bytes: Vec<u8> =
            read["data"].as_array().unwrap().iter().map(|byte| byte.as_u64().unwrap() as u8).collect();
        let numbers: Vec<f32> =
            bytes.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect();
        assert_eq!(numbers.len(), 7 * values.len());
        for ((point, value), place) in numbers.chunks(7).zip(values).zip(&surface.places()[start..]) {
            let place = place.unwrap();
            let want = [place.at.to_array(), place.normal.to_array()].concat();
            assert!(point.iter().zip(&want).all(|(own, want)| *own == *want as f32));
            assert_eq!(point[6], f32::from(*value));
        }
    }
}

#[test]
fn places_and_forces_on_links_are_those_of_the_board() {
    let all = Definitions::of_package();
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ros2-regions.toml");
    std::fs::write(&file, [include_str!("../../../bodies/reference.toml"), REGION].concat()).unwrap();
    let options = SourceOptions { body: Some(file.display().to_string()), ..SourceOptions::default() };
    let mut session = Session::over(source::open(&"sim:five".parse().unwrap(), &options).unwrap()).unwrap();
    session.parts().0.change_scene(taxel::client::SceneChange::pressing(u16::MAX));
    let (mut surface, mut reports, mut contacts, mut posed, mut clouds) = (None, 0, 0, 0, 0);
    let mut phases = BTreeSet::new();
    while let Some(event) = session.wait().unwrap() {
        match &event {
            Event::Hello => {
                let description = session.client().description().unwrap();
                let read = body::read("reference").unwrap();
                surface = Some(read.surface(&description.garment, &description.layout).unwrap());
            }
            Event::Pressing(report) => {
                if reports == 20 {
                    let turn = [0.0, 0.0, 0.6, 0.8];
                    let reported =
                        [("torso", [0.0, 0.1, 1.0], turn), ("left_upper_arm", [0.1, 0.0, 0.0], turn)];
                    setting::set_poses(session.parts().0, reported).unwrap();
                }
                same_report(&all, session.client(), report);
                let mut counts = session.client().clone();
                counts.weigh_by(ForceScale::default());
                same_report(&all, &counts, report);
                contacts += same_contacts(&all, &session, surface.as_ref().unwrap(), report);
                posed += report.contacts.iter().filter(|landed| landed.base.is_some()).count();
                reports += 1;
            }
            Event::Regions(report) => {
                same_regions(&all, session.client(), report);
                phases.insert(report.regions[0].phase as u8);
            }
            Event::Frame { alone: true, .. } => {
                same_points(session.client(), surface.as_ref().unwrap());
                clouds += 1;
            }
            _ => {}
        }
    }
    println!("{reports} reports, {contacts} contacts, {posed} of them in the base, {clouds} clouds");
    assert!(reports > 100 && contacts > 300 && posed > 100 && clouds > 1);
    assert!(phases.len() > 2, "{phases:?}");
}

#[test]
fn a_link_without_a_touch_has_no_force_and_a_panel_without_a_place_no_points() {
    let read = pressing::wrench(US, "torso", None, None);
    let read = Definitions::of_text("W", schemas::WRENCH).read("W", &read);
    assert_eq!(read["wrench"]["force"], json!({ "x": 0.0, "y": 0.0, "z": 0.0 }));
    let garment = taxel_core::garment::Garment::reference();
    let layout = taxel_core::garment::Layout::build(&garment, 2048, 4095).unwrap();
    let mut body = body::read("reference").unwrap().body;
    body.patches.truncate(1);
    let surface = Surface::build(&body, &garment, &layout).unwrap();
    let values = [0; 512];
    for (index, area) in layout.areas().iter().enumerate() {
        let reported = pressing::points("", US, area, Some(&surface), &values);
        // In the frame of the link, or of the panel.
        let link = Definitions::of_text("P", schemas::POINT_CLOUD).read("P", &reported)["header"]["frame_id"]
            .clone();
        assert_eq!(link, json!(["torso", "tactile/back", "tactile/left_arm", "tactile/right_arm"][index]));
        assert_eq!(reported == messages::points("", US, area, &values), index > 0);
    }
}
