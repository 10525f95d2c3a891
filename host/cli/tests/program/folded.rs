//! A simulated arm that bends, from the newcomer's hands: recorded, learned, and no touch any more.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("folded");
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn run(args: &[&str]) -> Output {
    let done = Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).output().unwrap();
    assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
    done
}

/// The lines of a type that `taxel live --json` prints.
fn lines(args: &[&str], kind: &str) -> Vec<Value> {
    let live = [&["live", "--source", "sim:elbow", "--for", "2.6s", "--json"], args].concat();
    let printed = String::from_utf8(run(&live).stdout).unwrap();
    let lines = printed.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    lines.filter(|line| line["type"] == kind).collect()
}

/// A table of folds, learned once from the script that ships with other noise: tests that run side by side
/// would write each other's recording anew.
pub static TABLE: LazyLock<PathBuf> = LazyLock::new(|| {
    let (recording, table) = (file("elbow.mcap"), file("elbow.folds"));
    let [recording_name, table_name] = [&recording, &table].map(|path| path.to_str().unwrap());
    let record = ["record", "--source", "sim:elbow", "--seed", "7", "--for", "2.6s", "--force"];
    run(&[&record[..], &["-o", recording_name]].concat());
    let said = run(&["body", "learn", recording_name, "--force", "-o", table_name]).stdout;
    assert!(String::from_utf8(said).unwrap().contains("left_elbow"));
    table
});

#[test]
fn a_bent_elbow_means_nothing_once_it_is_learned() {
    let touched = |frames: &[Value]| {
        frames.iter().filter(|frame| !frame["contacts"].as_array().unwrap().is_empty()).count()
    };
    let meant = |frames: &[Value]| frames.iter().filter(|it| it["intent"]["leading"] != "none").count();
    let without = lines(&[], "frame");
    assert!(touched(&without) > 100, "without a table it is a touch");
    let with = lines(&["--folds", TABLE.to_str().unwrap()], "frame");
    assert!(with.len() > 450, "{} frames", with.len());
    assert_eq!((touched(&with), meant(&with)), (0, 0), "from beginning to end");
    let folds = lines(&["--folds", TABLE.to_str().unwrap()], "folds");
    // The first one is of the tare.
    assert!(folds.len() > 20 && folds[1..].iter().all(|printed| printed["followed"] == true), "{folds:?}");
}

#[test]
fn a_table_for_another_garment_is_refused_by_name() {
    let live = ["live", "--source", "sim:pat", "--garment", "mat-64x32", "--folds", TABLE.to_str().unwrap()];
    let done = Command::new(env!("CARGO_BIN_EXE_taxel")).args(live).output().unwrap();
    let error = String::from_utf8(done.stderr).unwrap();
    let why = "elbow.folds: folds must be made for this garment";
    assert!(!done.status.success() && error.contains(why), "{error}");
}
