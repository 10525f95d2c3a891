//! `taxel setup` and `taxel calibrate settle` from outside: a garment's wiring, found by touch and by itself.

use crate::called::{file, run};
use serde_json::Value;

#[test]
fn a_garment_is_set_up_by_touch() {
    let output = file("touched.toml", b"");
    let said = run(&["setup", "--simulate", "7", "--json", "--force", "-o", &output]);
    assert!(said.status.success(), "{said:?}");
    let lines: Vec<Value> = String::from_utf8(said.stdout)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let kinds = |kind: &str| lines.iter().filter(|line| line["type"] == kind).count();
    assert_eq!((kinds("ask"), kinds("felt"), kinds("found")), (9, 9, 1));
    let garment = taxel::files::garments::load(&output).unwrap();
    assert_eq!(serde_json::to_value(&garment).unwrap(), lines.last().unwrap()["garment"]);
    let said = run(&["setup", "--simulate", "7"]);
    let text = String::from_utf8(said.stdout).unwrap();
    assert!(text.contains("9. Panel right arm: press") && text.contains("\n[wiring]\n"), "{text}");
    let said = run(&["setup", "--simulate", "7", "--garment", "block-4x16"]);
    let why = String::from_utf8(said.stderr).unwrap();
    assert!(said.status.code() == Some(1) && why.contains("only binary addresses do"), "{why}");
}

#[test]
fn nobody_touches_and_nothing_is_claimed() {
    let idle = file("nobody.toml", b"duration_s = 1\n[idle]\nspread_counts = 1\n");
    let source = format!("sim:{idle}");
    let said = run(&["setup", "--source", &source, "--wait", "300ms"]);
    let why = String::from_utf8(said.stderr).unwrap();
    assert!(
        said.status.code() == Some(1) && why.contains("not sure: Nothing was felt on any panel"),
        "{why}"
    );
    let said = run(&["calibrate", "settle", "--source", &source, "--json"]);
    let why = String::from_utf8(said.stderr).unwrap();
    assert!(said.status.code() == Some(1) && why.contains("too few edges"), "{why}");
}

#[test]
fn settling_is_found_and_written() {
    let weights = concat!("sim:", env!("CARGO_MANIFEST_DIR"), "/../../examples/scenes/weights.toml");
    let output = file("settled.toml", b"");
    let said = run(&["calibrate", "settle", "--source", weights, "--json", "--force", "-o", &output]);
    assert!(said.status.success(), "{said:?}");
    let settled: Value = serde_json::from_slice(&said.stdout).unwrap();
    // 800 ns and 4 of 4,095 counts: 5,545 ns, three conversions; a second round of the four inputs takes less
    // time than a slower pace.
    assert_eq!(settled["in_slots_ns"], 12_000);
    assert_eq!(settled["measured"], serde_json::json!([26, 27, 28, 29]));
    let garment = taxel::files::garments::load(&output).unwrap();
    assert_eq!(settled["settle_ns"], garment.wiring.settle_ns);
}

/// Nine touches in the order of the requests, on a garment wired as shipped.
#[test]
fn a_board_is_set_up_by_touch() {
    let mut script = String::from("duration_s = 30\n");
    let mut touch = |panel: &str, at: [f64; 2], velocity: [f64; 2], hold_s: f64, number: usize| {
        script += &format!(
            "[[touch]]\npanel = \"{panel}\"\nshape = \"finger\"\nforce_n = 8\nsize_mm = [26, 22]\nat = {at:?}\n\
             velocity = {velocity:?}\nstart_s = {}\nrise_s = 0.05\nhold_s = {hold_s}\nfall_s = 0.05\n",
            0.5 + 2.5 * number as f64
        );
    };
    let panels = ["chest", "back", "left arm", "right arm"];
    for (number, panel) in panels.iter().enumerate() {
        touch(panel, [3.4, 0.0], [0.0, 20.0], 1.45, number);
    }
    touch("chest", [0.0, 17.0], [12.0, 0.0], 1.15, 4);
    for (number, panel) in panels.iter().enumerate() {
        touch(panel, [0.3, 0.4], [0.0, 0.0], 0.4, 5 + number);
    }
    let source = format!("sim:{}", file("nine.toml", script.as_bytes()));
    let output = file("found.toml", b"");
    let said = run(&["setup", "--source", &source, "--json", "--force", "-o", &output]);
    assert!(
        said.status.success(),
        "{}{}",
        String::from_utf8_lossy(&said.stdout),
        String::from_utf8_lossy(&said.stderr)
    );
    let found = taxel::sim::Decoder::build(&taxel::files::garments::load(&output).unwrap());
    let wired = taxel::sim::Decoder::build(&taxel_core::garment::Garment::reference());
    // All levels of the nine address lines, on every input.
    let lines = [2, 3, 6, 7, 8, 9, 10, 11, 12];
    for word in 0..512u64 {
        let levels = lines.iter().enumerate().map(|(bit, pin)| (word >> bit & 1) << pin).sum();
        let shown =
            |decoder: &taxel::sim::Decoder, input| decoder.taxel(decoder.address(levels).unwrap(), input);
        assert!((0..4).all(|input| shown(&found, input) == shown(&wired, input)), "{word:#b}");
    }
}
