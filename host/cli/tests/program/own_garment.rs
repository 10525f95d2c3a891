//! A user's own garment: created, checked, and simulated with any script of touches.

use super::tools::{file, refused, run, said};
use serde_json::Value;

/// A file created like a preset, with changes.
fn mine(name: &str, like: &str, changes: &[(&str, &str)]) -> String {
    let path = file(name);
    let name = path.to_str().unwrap().to_string();
    said(&["config", "new", &name, "--like", like]);
    let mut text = std::fs::read_to_string(&path).unwrap();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    std::fs::write(&path, text).unwrap();
    name
}

#[test]
fn a_file_that_is_begun_keeps_the_comments_of_what_it_is_like() {
    let first =
        mine("commented.toml", "block-4x16", &[("pin = 12", "pin = 18"), ("# lowest", "# MINE: lowest")]);
    let text = std::fs::read_to_string(&first).unwrap();
    for line in include_str!("../../../taxel/garments/block-4x16.toml")
        .lines()
        .filter(|line| !line.contains("pin = 12"))
    {
        assert!(text.contains(line), "{line}");
    }
    // Also one created like that file; it has one line for the schema.
    let second = std::fs::read_to_string(mine("commented-2.toml", &first, &[])).unwrap();
    assert!(second.contains("# MINE: lowest bit first") && second.contains("pin = 18"), "{second}");
    assert_eq!(second.matches("#:schema").count(), 1);
    assert!(said(&["config", "check", "mat-64x32"]).starts_with("mat-64x32: garment mat-64x32, 2048 taxels"));
}

#[test]
fn any_script_is_played_on_a_garment_of_ones_own() {
    // GP18, which the shipped scene drives by a reaction, is a line of this garment.
    let changes = [("name = \"block-4x16\"", "name = \"mine\""), ("pin = 12", "pin = 18")];
    let garment = mine("mine-simulated.toml", "block-4x16", &changes);
    let asked = ["live", "--source", "sim:pat", "--garment", &garment, "--json", "--for", "0.5s"];
    let output = run(&asked);
    let printed = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{printed}");
    assert_eq!(printed.matches("sim:pat: the garment mine has no panel back").count(), 1, "{printed}");
    assert!(printed.contains("what touches there touches mat."), "{printed}");
    assert!(printed.contains("the reaction over-pressure drives no pin: GP18"), "{printed}");
    let lines: Vec<Value> = String::from_utf8(output.stdout)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let hello = lines.iter().find(|line| line["type"] == "hello").unwrap();
    assert_eq!(hello["garment"], "mine");
    let touched = |line: &&Value| line["contacts"].as_array().is_some_and(|contacts| !contacts.is_empty());
    assert!(lines.iter().any(|line| touched(&line)), "the pat is felt on the mat");
}

#[test]
fn a_garment_that_cannot_be_is_reported_by_file_line_and_key_before_it_is_simulated() {
    let fine = mine("fine.toml", "block-4x16", &[("[10000, 10000]", "[10, 10]")]);
    let line = std::fs::read_to_string(&fine)
        .unwrap()
        .lines()
        .position(|line| line.starts_with("pitch_um"))
        .unwrap()
        + 1;
    let said = format!(
        "{fine}, line {line}, `panels[0].pitch_um`: panel mat: pitch_um is 10, outside 500 to 200000: did you mean 10000?"
    );
    for command in [&["config", "check", &fine][..], &["live", "--source", "sim:pat", "--garment", &fine]] {
        let why = refused(1, command);
        assert!(why.contains(&said), "{command:?}: {why}");
    }
}

#[test]
fn a_script_that_is_not_known_is_reported_with_the_one_that_was_meant() {
    let why = refused(2, &["live", "--source", "sim:pta"]);
    assert!(
        why.contains("there is no script of touches \"pta\": did you mean \"pat\"? Known are pat, "),
        "{why}"
    );
    let garment = refused(2, &["live", "--source", "sim:pat", "--garment", "mat-64x23"]);
    assert!(garment.contains("there is no garment \"mat-64x23\": did you mean \"mat-64x32\"?"), "{garment}");
}

#[test]
fn a_grid_takes_the_place_of_wiring() {
    let path = file("grid.toml");
    let name = path.to_str().unwrap();
    std::fs::write(&path, "name = \"sole\"\n[grid]\nrows = 12\ncolumns = 21\npitch_um = [5000, 8000]\n")
        .unwrap();
    assert!(
        said(&["config", "check", name]).contains("garment sole, 252 taxels in 1 panel and 0 blocks: fits")
    );
    std::fs::write(&path, "name = \"sole\"\n[grid]\nrows = 0\ncolumns = 21\n").unwrap();
    let why = refused(1, &["config", "check", name]);
    assert!(why.contains("line 3, `grid.rows`"), "{why}");
    std::fs::write(&path, "name = \"sole\"\nblocks = []\n[grid]\nrows = 2\ncolumns = 2\n").unwrap();
    let why = refused(1, &["config", "check", name]);
    assert!(why.contains("line 2, `blocks`: a garment has either wiring and panels, or [grid]"), "{why}");
}
