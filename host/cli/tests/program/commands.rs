//! `taxel save` and `taxel health` on a simulated board, from outside.

use crate::start::taxel;
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};

fn run(args: &[&str]) -> Output {
    Command::new(taxel()).args(args).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// The source of a scene of this test.
fn scene(name: &str, script: &str) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("commands");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, script).unwrap();
    format!("sim:{}", path.display())
}

/// A pen on a taxel from this time on.
fn pen(panel: &str, row: u16, column: u16, force_n: f64) -> String {
    format!(
        "[[touch]]\npanel = \"{panel}\"\nshape = \"box\"\nsize_mm = [8, 8]\nat = [{column}, {row}]\nforce_n = {force_n}\n\
         start_s = 0.3\nrise_s = 0.05\nhold_s = 5\n"
    )
}

#[test]
fn settings_are_stored_or_it_is_said_why_not() {
    let done = run(&["save", "--source", "sim:idle", "--tare", "20"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(
        text(&done.stdout),
        "sim:idle is simulated: what it has saved is gone once it ends, nothing lasts.\n"
    );
    let touched = scene("touched.toml", &format!("duration_s = 9\n{}", pen("back", 4, 4, 9.0)));
    let other = run(&["save", "--source", &touched, "--garment", "no-such-garment"]);
    assert_eq!(other.status.code(), Some(2));
    assert!(other.stdout.is_empty() && text(&other.stderr).contains("no-such-garment"));
}

#[test]
fn health_names_what_is_faulty_and_where() {
    let taxels = "stuck = [{ taxel = 77, code = 300 }]\nnoisy = [{ taxel = 1700, counts = 60 }]";
    let faulty = scene("faulty.toml", &format!("duration_s = 2\n[faults]\n{taxels}"));
    let args = ["health", "--source", &faulty, "--tare", "16", "--self-test", "--json"];
    let done = run(&args);
    assert_eq!(done.status.code(), Some(3), "{}", text(&done.stderr));
    let printed: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(printed["self_test"], json!({ "lines": 9, "inputs": 4, "faults": [] }));
    assert_eq!([&printed["simulated"], &printed["ghosts"]], [&json!(true), &Value::Null]);
    let place = |taxel: u16, health: &str, panel: &str, row: u16, column: u16, block: u8| {
        json!({ "taxel": taxel, "health": health, "panel": panel, "row": row, "column": column, "block": block,
            "wired_row": row % 4, "wired_column": column })
    };
    let expected = [place(77, "stuck", "chest", 4, 13, 1), place(1700, "noisy", "right arm", 10, 4, 26)];
    assert_eq!(printed["taxels"], json!(expected));
    let table = run(&args[..args.len() - 1]);
    let lines: Vec<&str> = text(&table.stdout).lines().collect();
    assert_eq!(
        lines[..2],
        ["This is a simulated board.", "reference: no faults on 9 select lines and 4 inputs."]
    );
    assert_eq!(lines[2], "stuck    chest, row 4, column 13 (block 1, its row 0, column 13; taxel 77)");
}

#[test]
fn a_broken_line_is_named_and_the_command_fails() {
    let broken = "duration_s = 2\n[faults]\npins = [{ pin = 8, fault = \"stuck-high\" }]";
    let done = run(&["health", "--source", &scene("broken.toml", broken)]);
    assert_eq!(done.status.code(), Some(3));
    assert!(text(&done.stdout).contains("\nGPIO 8 ("), "{}", text(&done.stdout));
    assert!(text(&done.stderr).contains("faults of lines and inputs: 1"));
}
