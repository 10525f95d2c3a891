//! What stays valid is known from the beginning of a file that continues another, and after a jump.

use super::stage::{View, file, recorded};
use serde_json::json;
use std::path::Path;
use taxel::client::{Client, Event};
use taxel::record::Play;
use taxel_core::shape::Class;

/// A body with a region that has a name.
const REGION: &str =
    "[[regions]]\nname = \"heart\"\nlink = \"torso\"\nwithin.box = { from = [-1, -1, -1], to = [1, 1, 1] }\n";

/// What a client knows that lasts: names, settings, faults, findings.
fn known(client: &Client) -> [String; 5] {
    let description = client.description().unwrap();
    let shapes: Vec<String> = (0..6).map(|class| client.shape_name(Class(class))).collect();
    [
        format!(
            "{} {} {} {}",
            description.garment.name, description.scene.name, description.calibration, description.firmware
        ),
        client.surface_region(0).into(),
        shapes.join(" "),
        format!("{:?}", client.faulty()),
        format!("{:?}", client.self_test()),
    ]
}

/// What is known at the first image of a recording, and at its last.
fn first_and_last(path: &Path) -> [[String; 5]; 2] {
    let mut play = Play::open(&path.into()).unwrap();
    let mut first = None;
    while let Some((_, event)) = play.next_event().unwrap() {
        if first.is_none() && matches!(event, Event::Frame { .. }) {
            first = Some(known(play.client()));
        }
    }
    [first.expect("it has an image"), known(play.client())]
}

/// Records a board with taught shapes and a region, in files of a second.
fn board(name: &str, more: &[&str]) -> std::path::PathBuf {
    let body = file(&format!("{name}.toml"));
    let text = include_str!("../../../../taxel/bodies/reference.toml").to_string() + REGION;
    std::fs::write(&body, text).unwrap();
    let set = ["--garment", "reference", "--body", body.to_str().unwrap(), "--shapes", "drawn"];
    recorded(name, "sim:five", 3, &[&set[..], more].concat())
}

#[test]
fn a_file_that_continues_another_knows_what_lasts() {
    let path = board("retained.mcap", &["--rotate", "1s"]);
    let [_, known] = first_and_last(&path);
    assert_eq!((known[1].as_str(), known[2].split(' ').nth(1)), ("heart", Some("disc")), "{known:?}");
    for number in 2..=3 {
        let next = path.with_file_name(format!("retained-{number:04}.mcap"));
        assert_eq!(first_and_last(&next), [known.clone(), known.clone()], "{}", next.display());
    }
}

#[test]
fn a_jump_knows_what_lasts() {
    let path = board("jumped.mcap", &[]);
    let [_, known] = first_and_last(&path);
    let view = View::start(&[path.to_str().unwrap()]);
    let mut page = view.page();
    page.stand();
    page.ask(json!({ "range": [2.1, 2.8] }));
    page.line("player", |line| line["range"] == json!([2.1, 2.8]));
    assert_eq!(first_and_last(&view.save("jumped-part.mcap")), [known.clone(), known]);
}
