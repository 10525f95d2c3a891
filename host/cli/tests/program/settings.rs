//! Every setting of a board, as an option, as a key of a robot's file, and of one board among two: the board says the
//! same.

use super::called::{answer, file};
use super::folded::TABLE;
use super::robot::folder;
use serde_json::Value;
use std::path::Path;
use taxel::robot::BoardConfig;

/// A map of a single concept, which only a host can feed.
const WARM: &str = "name = \"warm\"\nlambda = 1\n[[concept]]\nname = \"warmth\"\n[[concept]]\nname = \"kindness\"\n\
                    [[input]]\nconcept = \"warmth\"\nsource = { host = 3 }\nrise = [-32768, 32768]\nat = [-1, 1]\n\
                    [[edge]]\nfrom = \"warmth\"\nto = \"kindness\"\nweight = 1\n";

/// A script, and the settings with their values. Each row changes what the board says; the first key is the row's.
const ROWS: [(&str, &[(&str, &str)]); 15] = [
    ("sim:idle", &[("garment", "mat-64x32")]),
    ("sim:pat", &[("scene", "SCENE")]),
    ("sim:press", &[("calibration", "CALIBRATION"), ("garment", "block-4x16")]),
    ("sim:pat", &[("tare", "9")]),
    ("sim:pat", &[("budget", "65535")]),
    ("sim:pat", &[("raw", "true")]),
    ("sim:pat", &[("gestures", "intent")]),
    ("sim:pat", &[("gesture_gain", "1.5"), ("gestures", "gestures")]),
    ("sim:pat", &[("gesture_certainty", "0.5"), ("gestures", "gestures")]),
    ("sim:five", &[("forms", "all")]),
    ("sim:lash", &[("feed", "warmth=0.75,0,60000,-0.5"), ("scene", "SCENE")]),
    ("sim:pat", &[("shapes", "drawn")]),
    ("sim:pat", &[("body", "reference"), ("garment", "reference")]),
    ("sim:elbow", &[("folds", "FOLDS")]),
    ("sim:pat", &[("pressing", "7"), ("body", "reference"), ("garment", "reference")]),
];

/// The stream of a command as JSON, without what differs between hosts: names and the host's times.
fn stream(words: &[&str], board: Option<&str>) -> Vec<Value> {
    let text = answer(&[words, &["--for", "0.6s", "--json"]].concat());
    let lines = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let of_board = |line: &Value| board.is_none_or(|name| line["board"] == name && line["type"] != "board");
    let plain = |mut line: Value| {
        let fields = line.as_object_mut().unwrap();
        fields.retain(|key, _| !["board", "source"].contains(&key.as_str()) && !key.starts_with("host_"));
        line
    };
    let mut lines: Vec<Value> = lines.filter(of_board).map(plain).collect();
    // When a long request has been read depends on the threads of the host.
    let is_late = |line: &Value| line["time_us"].as_u64().is_none_or(|time| time > 200_000);
    lines.retain(|line| line["type"] == "hello" || is_late(line));
    lines.sort_by_cached_key(|line| (line["type"] == "answer").then(|| line.to_string()));
    lines
}

/// A value as the command line has it, and as TOML has it.
fn value(text: &str, files: &[(&str, &str)]) -> (String, String) {
    let text = files.iter().find(|(name, _)| *name == text).map_or(text, |(_, path)| path);
    let is_plain = text.parse::<f64>().is_ok() || text == "true";
    (text.into(), if is_plain { text.into() } else { format!("\"{text}\"") })
}

#[test]
fn each_setting_works_for_a_board_and_for_a_board_of_a_robot() {
    let (scene, _) = (
        file("warm.toml", b"react = []\n[intent]\nmap = \"warm map.toml\"\n"),
        file("warm map.toml", WARM.as_bytes()),
    );
    let calibration = file("settings.toml", b"");
    answer(&[
        "calibrate",
        "--garment",
        "block-4x16",
        "--simulate",
        "11",
        "--by",
        "Anna",
        "--force",
        "-o",
        &calibration,
    ]);
    let files =
        [("SCENE", scene.as_str()), ("CALIBRATION", &calibration), ("FOLDS", TABLE.to_str().unwrap())];
    let mut known: Vec<&str> = Vec::new();
    for (script, settings) in ROWS {
        known.push(settings[0].0);
        let (mut options, mut keys) = (Vec::new(), String::new());
        for (key, text) in settings {
            let (word, toml) = value(text, &files);
            options.push(format!("--{}", key.replace('_', "-")));
            options.extend((*key != "raw").then_some(word));
            let toml = if *key == "feed" { format!("[{toml}]") } else { toml };
            keys += &format!("{key} = {toml}\n");
        }
        let board =
            |name: &str, keys: &str| format!("[[boards]]\nname = \"{name}\"\nsource = \"{script}\"\n{keys}");
        let robots = [board("it", &keys), board("it", &keys) + &board("other", "")];
        let [one, two] = robots.map(|boards| format!("name = \"robot\"\n{boards}"));
        let key = settings[0].0;
        let folders = [folder(&format!("one-{key}"), &one), folder(&format!("two-{key}"), &two)];
        let options: Vec<&str> = options.iter().map(String::as_str).collect();
        let alone = stream(&[&["live", "--source", script], &options[..]].concat(), None);
        assert!(alone.len() > 50, "{settings:?}");
        assert_ne!(alone, stream(&["live", "--source", script], None), "{settings:?} has an effect");
        for (folder, boards) in folders.iter().zip(["alone", "of two"]) {
            let of_robot = stream(&["live", &path(folder)], Some("it"));
            let differs = alone.iter().zip(&of_robot).find(|(alone, of_robot)| alone != of_robot);
            assert!(
                alone == of_robot,
                "{settings:?}, {boards}: {} and {} lines, {differs:#?}",
                alone.len(),
                of_robot.len()
            );
        }
    }
    let unknown = toml::from_str::<BoardConfig>("name = \"it\"\nno_such_key = 1").unwrap_err().to_string();
    let (_, keys) = unknown.split_once("expected one of").expect(&unknown);
    let keys = keys.split('`').skip(1).step_by(2).filter(|key| !["name", "source", "link"].contains(key));
    keys.for_each(|key| assert!(known.contains(&key), "{key} has no row"));
}

fn path(folder: &Path) -> String {
    folder.join("robot.toml").display().to_string()
}
