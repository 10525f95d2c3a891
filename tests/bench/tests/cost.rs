//! Cost of recording compared with perception, and speed of replay: printed, never judged.

use std::path::Path;
use taxel_bench::record::measure;

#[test]
fn costs_are_printed() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cost");
    let cost = measure(&folder).unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    assert!(cost.frames > 400 && (5000.0..5300.0).contains(&cost.period), "{cost:?}");
    let rows = cost.json()["rows"].as_array().unwrap().clone();
    assert!(rows.iter().all(|row| cost.table().contains(row[0].as_str().unwrap())));
    assert!(cost.perceived > 0.0 && cost.replayed > 0.0, "{cost:?}");
    println!("{}", cost.table());
}
