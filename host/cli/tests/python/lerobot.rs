//! A LeRobot data set of two recordings, read row by row by pyarrow.

use super::read;
use super::stage::{Seen, file, plan, record};
use serde_json::json;
use std::num::NonZeroU16;
use taxel_cli::commands::recordings::export::{ExportArgs, Form, run};
use taxel_cli::watch::Overwrite;

const FPS: u16 = 50;

/// Image of each row: the last one so far at its time.
fn rows(seen: &Seen) -> Vec<&[u16]> {
    let began = seen.frames[0].1;
    let last = seen.frames[seen.frames.len() - 1].1;
    let times = (0..).map(|row: u64| began * u64::from(FPS) + row * 1_000_000);
    let times = times.take_while(|time| *time <= last * u64::from(FPS));
    let image = |time| {
        let after = seen.frames.partition_point(|(_, us, _)| us * u64::from(FPS) <= time);
        seen.frames[after - 1].2.as_slice()
    };
    times.map(image).collect()
}

#[test]
fn every_row_is_the_image_of_its_time() {
    let names = ["arrow-pat.mcap", "arrow-five.mcap"];
    let seen = ["sim:pat", "sim:five"].map(|scene| {
        let name = names[usize::from(scene == "sim:five")];
        record(scene, plan(name, "sim", None, false))
    });
    let folder = file("arrow");
    let _ = std::fs::remove_dir_all(&folder);
    let args = ExportArgs::of(names.map(file).to_vec(), Form::Lerobot, folder.clone());
    let task = "pat the robot".to_string();
    run(ExportArgs {
        counts: true,
        force: Overwrite { force: true },
        fps: NonZeroU16::new(FPS).unwrap(),
        task,
        ..args
    })
    .unwrap();
    let found = read("lerobot", &folder);
    let rows: Vec<Vec<&[u16]>> = seen.iter().map(rows).collect();
    assert_eq!(found["lengths"], json!(rows.iter().map(Vec::len).collect::<Vec<_>>()));
    assert_eq!(found["info"]["fps"], FPS);
    for (panel, name) in ["chest", "back", "left_arm", "right_arm"].into_iter().enumerate() {
        let images = rows.iter().flatten().flat_map(|image| &image[512 * panel..][..512]);
        let bytes: Vec<u8> = images.flat_map(|value| f32::from(*value).to_le_bytes()).collect();
        assert_eq!(found["panels"][format!("observation.tactile.{name}")], crc32fast::hash(&bytes), "{name}");
    }
    assert_eq!(found["tasks"], json!({ "task_index": [0], "task": ["pat the robot"] }));
    assert_eq!(found["index"], json!(["task"]));
    println!("pyarrow reads {} rows of a data set for LeRobot as they were", found["info"]["total_frames"]);
}
