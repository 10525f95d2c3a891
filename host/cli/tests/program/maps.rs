//! `taxel fcm` from outside: places of errors in maps, and opinions by map.

use crate::called::{answer, file, json, refused, run};
use serde_json::Value;

const MAP: &str = r#"name = "tactile"
[[concept]]
name = "press"
[[concept]]
name = "attack"
[[input]]
concept = "press"
source = "press"
rise = [0, 100]
[[edge]]
from = "press"
to = "attack"
weight = 0.5
"#;

#[test]
fn a_wrong_map_is_reported_by_line_and_key() {
    for (from, to, printed) in [
        (
            "weight = 0.5",
            "weight = 2",
            "line 13, `weight`: map tactile: W[press][attack] = 2 is outside [-1, 1]",
        ),
        (
            "to = \"attack\"",
            "to = \"joy\"",
            "line 12, `to`: map tactile: an edge names the unknown concept joy",
        ),
        ("weight = 0.5", "weight = [1]", "line 13, `weight`: must be a number in -1 ..= 1 or a term"),
        (
            "rise = [0, 100]",
            "rise = [9, 1]",
            "line 6, `input`: map tactile: input press: the points [9, 1] do not rise",
        ),
        (
            "name = \"attack\"",
            "name = \"an attack of somebody\"",
            "line 5, `name`: map tactile: concept an attack",
        ),
        ("source =", "sauce =", "line 8: `sauce` is not a known key, did you mean `source`?"),
    ] {
        let text = MAP.replacen(from, to, 1).replace(
            "to = \"attack\"\n",
            match from {
                "name = \"attack\"" => "to = \"an attack of somebody\"\n",
                _ => "to = \"attack\"\n",
            },
        );
        let map = file("wrong.toml", text.as_bytes());
        let output = run(&["fcm", "check", &map]);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && error.contains(printed), "{printed}\n{error}");
        assert!(error.starts_with(&format!("error: {map}, line ")) && error.lines().count() == 1, "{error}");
    }
}

#[test]
fn a_name_that_is_no_map_is_wrong_use() {
    let output = run(&["fcm", "check", "tactil"]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("there is no map \"tactil\": did you mean \"tactile\"?"), "{error}");
}

#[test]
fn experts_are_distinguished_by_their_files() {
    let (anna, ben) =
        (file("anna.toml", MAP.as_bytes()), file("ben.toml", MAP.replace("0.5", "-0.25").as_bytes()));
    let ours = file("ours.toml", b"");
    let output = run(&["fcm", "combine", &anna, &ben, "--force", "-o", &ours]);
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.contains(&format!("0.5 ({anna}), -0.25 ({ben}); SIGNS CONFLICT")), "{table}");
    assert!(table.ends_with("ours: 2 concepts, 1 edges\n"), "{table}");
}

#[test]
fn bad_maps_are_refused_by_name() {
    let map = |name: &str, text: &str| file(name, text.as_bytes());
    let heavy = map("heavy.json", r#"{"names": ["a", "b"], "W": [[0, 2], [0, 0]], "x0": [1, 0]}"#);
    refused(1, &["fcm", &heavy, "--json"], &["heavy.json", "W[a][b] = 2", "[-1, 1]"]);
    let nan = map("nan.json", r#"{"names": ["a"], "W": [[NaN]], "x0": [1]}"#);
    refused(1, &["fcm", &nan], &["nan.json", "NaN"]);
    let short = map("short.json", r#"{"names": ["a", "b"], "W": [[0, 1], [0, 0]]}"#);
    refused(1, &["fcm", &short], &["short.json", "x0 is missing"]);
    refused(1, &["fcm", "/no/such/map.json"], &["/no/such/map.json", "cannot be read"]);
}

/// From the shipped map to a combined, a merged, a trained and a drawn one, and back to results.
#[test]
fn maps_are_made_of_maps() {
    let at = |name: &str| file(name, b"");
    let (ours, both, taught, drawn) = (at("ours.toml"), at("both.toml"), at("taught.toml"), at("map.dot"));
    let combined = json(&["fcm", "combine", "tactile", "tactile", "--force", "-o", &ours, "--json"]);
    assert_eq!(
        (combined["map"].as_str(), combined["edges"].as_array().map(Vec::len)),
        (Some("ours"), Some(41))
    );
    let merged = json(&["fcm", "merge", &ours, "shape", "--force", "-o", &both, "--json"]);
    assert_eq!(merged["concepts"].as_array().map(Vec::len), Some(28));
    assert!(merged["conflicts"][0].as_str().is_some_and(|said| said.contains(" of shape")), "{merged}");
    let checked = json(&["fcm", "check", &both, "--json"]);
    assert_eq!((checked["faults"].as_array().map(Vec::len), checked["cycles"].as_u64()), (Some(0), Some(0)));
    let why = json(&[
        "fcm",
        "why",
        &both,
        "--input",
        "time=-0.9",
        "--input",
        "shape=0.1",
        "--set",
        "time=0.9",
        "--json",
    ]);
    let units = |list: &str| {
        why[list].as_array().unwrap().iter().map(|one| one["units"].as_i64().unwrap()).sum::<i64>()
    };
    assert_eq!(
        (why["concept"].as_str(), units("parts"), units("paths")),
        (Some("attack"), units("paths"), why["sum_units"].as_i64().unwrap())
    );
    let attack = |value: &Value| value["activations"]["attack"].as_f64().unwrap();
    assert!(attack(&why) > 0.9 && attack(&why["what_if"]) < 0.5, "{why}");
    let touches =
        file("blows.csv", b"time,location,label\n-0.9,0.1,attack\n-0.01,0.9,none\n-0.8,0,attack\n0,0,none\n");
    let learned = json(&[
        "fcm",
        "learn",
        "tactile",
        "--touches",
        &touches,
        "--force",
        "-o",
        &taught,
        "--folds",
        "2",
        "--json",
    ]);
    assert_eq!((learned["touches"].as_u64(), learned["after"]["accuracy"].as_f64()), (Some(4), Some(1.0)));
    answer(&["fcm", "draw", &taught, "--force", "-o", &drawn, "--input", "press=0.5"]);
    assert!(std::fs::read_to_string(&drawn).unwrap().contains("\"press\" [label=\"press +0.50\""));
    let run = json(&["fcm", &taught, "--input", "shape=1", "--json"]);
    assert_eq!(run["f64"]["outcome"], "fixed");
    let broken = file("broken.toml", b"name = \"m\"\n[[concept]]\nname = 3\n");
    for command in [
        &["fcm", "check", &broken][..],
        &["fcm", &broken],
        &["fcm", "why", &broken],
        &["fcm", "draw", &broken, "--force", "-o", &drawn],
    ] {
        refused(1, command, &["broken.toml, line 3"]);
    }
    refused(
        1,
        &["fcm", "learn", "tactile", "--touches", "/no/such.csv", "--force", "-o", &taught],
        &["/no/such.csv", "cannot be read"],
    );
}
