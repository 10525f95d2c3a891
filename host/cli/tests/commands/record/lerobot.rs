//! A LeRobot data set, as far as it can be tested without a Parquet reader; `tests/python` has one.

use super::stage::{file, plan, record};
use serde_json::Value;
use std::path::PathBuf;
use taxel_cli::commands::recordings::export::{ExportArgs, Form, run};
use taxel_cli::watch::Overwrite;

fn exported(name: &str, recordings: Vec<PathBuf>) -> anyhow::Result<PathBuf> {
    let folder = file(name);
    let _ = std::fs::remove_dir_all(&folder);
    run(ExportArgs {
        force: Overwrite { force: true },
        ..ExportArgs::of(recordings, Form::Lerobot, folder.clone())
    })?;
    Ok(folder)
}

fn read(path: PathBuf) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

#[test]
fn it_says_what_is_in_it() {
    let mut recordings = Vec::new();
    let mut rows = 0;
    for scene in ["pat", "lash"] {
        let name = format!("lerobot-{scene}.mcap");
        let seen = record(&format!("sim:{scene}"), plan(&name, "sim", None, false));
        let [first, last] = [seen.frames.first(), seen.frames.last()].map(|frame| frame.unwrap().1);
        rows += (last - first) * 30 / 1_000_000 + 1;
        recordings.push(file(&name));
    }
    let folder = exported("lerobot", recordings).unwrap();
    let info = read(folder.join("meta/info.json"));
    assert_eq!((&info["codebase_version"], info["fps"].as_u64()), (&"v3.0".into(), Some(30)));
    assert_eq!((info["total_frames"].as_u64(), info["total_episodes"].as_u64()), (Some(rows), Some(2)));
    let back = &info["features"]["observation.tactile.back"];
    assert_eq!((back["shape"].to_string(), &back["info"]["unit"]), ("[32,16]".into(), &"kPa".into()));
    assert_eq!(back["info"]["simulated"], true);
    assert!(info["features"]["observation.tactile.left_arm"].is_object());
    assert_eq!(info["features"]["observation.tactile.intent"]["names"].as_array().unwrap().len(), 20);
    let stats = read(folder.join("meta/stats.json"));
    let greatest = &stats["observation.tactile.back"]["max"];
    assert_eq!((greatest.as_array().unwrap().len(), greatest[0].as_array().unwrap().len()), (32, 16));
    assert_eq!(stats["index"]["max"][0].as_f64(), Some((rows - 1) as f64));
    for episode in ["file-000", "file-001"] {
        let bytes = std::fs::read(folder.join(format!("data/chunk-000/{episode}.parquet"))).unwrap();
        assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
    }
}

#[test]
fn a_folder_that_holds_something_is_left_alone() {
    record("sim:pat", plan("lerobot-once.mcap", "sim", None, false));
    let folder = exported("lerobot-once", vec![file("lerobot-once.mcap")]).unwrap();
    let again = ExportArgs::of(vec![file("lerobot-once.mcap")], Form::Lerobot, folder);
    let error = format!("{:#}", run(again).unwrap_err());
    assert!(error.contains("is not empty: name another folder, or --force"), "{error}");
    let many = ExportArgs::of(vec![file("a"), file("b")], Form::Npz, file("many.npz"));
    let error = run(many).unwrap_err().to_string();
    assert_eq!(error, "2 recordings: only --to lerobot takes more than one");
}
