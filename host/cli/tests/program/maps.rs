//! `taxel fcm` from outside: places of errors in maps, and opinions by map.

use std::path::PathBuf;
use std::process::{Command, Output};

fn taxel(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).output().unwrap()
}

fn file(name: &str, text: &str) -> String {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&file, text).unwrap();
    file.to_str().unwrap().into()
}

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
fn a_wrong_map_is_told_by_line_and_key() {
    for (from, to, told) in [
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
        let map = file("wrong.toml", &text);
        let output = taxel(&["fcm", "check", &map]);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && error.contains(told), "{told}\n{error}");
        assert!(error.starts_with(&format!("error: {map}, line ")) && error.lines().count() == 1, "{error}");
    }
}

#[test]
fn a_name_that_is_no_map_is_wrong_use() {
    let output = taxel(&["fcm", "check", "tactil"]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("there is no map \"tactil\": did you mean \"tactile\"?"), "{error}");
}

#[test]
fn experts_are_told_apart_by_their_files() {
    let (anna, ben) = (file("anna.toml", MAP), file("ben.toml", &MAP.replace("0.5", "-0.25")));
    let ours = file("ours.toml", "");
    let output = taxel(&["fcm", "combine", &anna, &ben, "--force", "-o", &ours]);
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.contains(&format!("0.5 ({anna}), -0.25 ({ben}); SIGNS CONFLICT")), "{table}");
    assert!(table.ends_with("ours: 2 concepts, 1 edges\n"), "{table}");
}
