//! Cost of recording compared with perception, speed of replay, and cost of a robot's mind: printed, and judged only
//! where it would not keep up by far.

use std::path::Path;
use taxel_bench::{mind, record::measure};

#[test]
fn costs_are_printed() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cost");
    let cost = measure(&folder).unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    assert!(cost.frames > 400 && (5000.0..5300.0).contains(&cost.period), "{cost:?}");
    let rows = cost.json()["rows"].as_array().unwrap().clone();
    assert!(rows.iter().all(|row| cost.table().contains(row[0].as_str().unwrap())));
    assert!(cost.perceived.elapsed > 0.0 && cost.replayed.elapsed > 0.0, "{cost:?}");
    let reported = std::fs::exists("/proc/thread-self/schedstat").unwrap();
    assert_eq!(cost.recorded.cpu.is_some_and(|us| us > 0.0), reported, "{cost:?}");
    println!("{}", cost.table());
}

#[test]
fn the_mind_of_many_boards_keeps_up() {
    let cost = mind::measure(&[1, 16]).unwrap();
    let rows = cost.json()["rows"].as_array().unwrap().clone();
    assert_eq!([rows[0][0].as_u64(), rows[1][0].as_u64()], [Some(1), Some(16)]);
    println!("{}", cost.table());
    // Each contact was compared with each other one in every scan: sixteen boards took ten cores.
    assert!(cost.read > 0.0 && rows.iter().all(|row| row[2].as_f64().unwrap() < 50.0), "{cost:?}");
}
