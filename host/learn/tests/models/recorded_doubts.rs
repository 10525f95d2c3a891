//! Reasons against conclusions from recorded touches, which a report names.

use crate::called::{done, folder};
use serde_json::Value;

#[test]
fn what_speaks_against_recorded_touches_is_reported() {
    let folder = folder("doubts");
    let quiet = |i: usize| (i / 64 * 37 + i % 64 * 11) as u16 % 600;
    let started = (0..20 * 64).map(|i| if i / 64 == 1 { 4000 } else { quiet(i) });
    let stopped = (0..20 * 64).map(|i| ((i / 64 * 379 + i % 64 * 113) as u16 % 2000).min(1500));
    // Two gestures by three people, eight times each, which all saturate; the first recording begins with a
    // transient.
    let two = started.chain(stopped).map(|value| value.min(500));
    let mut all = two.collect::<Vec<u16>>().repeat(24);
    all[..64 * 20].iter_mut().for_each(|value| *value /= 50);
    all[64..128].fill(500);
    let rows: Vec<String> = all
        .chunks(8)
        .enumerate()
        .map(|(row, cells)| {
            let cells: Vec<String> = cells.iter().map(u16::to_string).collect();
            cells.join(",") + if row % 8 == 7 { "\n\n" } else { "\n" }
        })
        .collect();
    std::fs::write(folder.join("touches.csv"), rows.concat()).unwrap();
    let labels: String =
        (0..48).map(|n| format!("{},{}\n", ["pat", "rub"][n % 2], ["ann", "bob", "cid"][n / 16])).collect();
    std::fs::write(folder.join("labels.csv"), format!("gesture,participant\n{labels}")).unwrap();
    let cross = ["--cross", "participant", "--json"];
    let files = ["--frames", "touches.csv", "--labels", "labels.csv"];
    let (text, error) = done(&folder, &[&["gestures", "eval"][..], &files, &cross].concat());
    assert!(error.contains("warning: 1 of 48 recordings, recording 0: frame 1 has "), "{error}");
    assert!(
        error.contains("warning: saturation: values stop at 500 in 100 % of pat, 100 % of rub"),
        "{error}"
    );
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(report["doubts"].as_array().map(Vec::len), Some(2));
    assert!(report["reliability"]["predictions"].as_u64() > Some(0), "{report}");
}
