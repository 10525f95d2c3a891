//! Files of a recording of a robot: each stands alone, and together they hold what one file holds.

use super::robot::{folder, two};
use crate::start::taxel;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use taxel::client::{Event, ImageNews};
use taxel::record::{COUNTS, Play, Tally};
use taxel::recording::{Overview, scan};

const BOARDS: [&str; 2] = ["torso", "hand"];

/// Runs `taxel record robot.toml` into this file. Returns what it says.
fn record(folder: &Path, file: &str, more: &[&str]) -> String {
    let args = ["record", "robot.toml", "--raw", "--for", "3s", "--force", "-o", file];
    let done = Command::new(taxel()).current_dir(folder).args(args).args(more).output().unwrap();
    let said = String::from_utf8(done.stderr).unwrap();
    assert!(done.status.success(), "{said}");
    said
}

/// Number and pixels of each image of a board; those that cannot be decoded are none.
fn images(path: &Path, board: &str) -> Vec<(u32, Option<Vec<u16>>)> {
    let mut play = Play::open(&format!("{}#{board}", path.display()).into()).unwrap();
    let mut images = Vec::new();
    while let Some((_, event)) = play.next_event().unwrap() {
        if let Event::Frame { frame, image, .. } = event {
            let pixels = play.client().image().map(|(_, image)| image.to_vec());
            images.push((frame, pixels.filter(|_| image == ImageNews::Whole)));
        }
    }
    images
}

/// Messages of each topic.
fn counted(path: &Path) -> BTreeMap<String, u64> {
    let scan = scan(path).unwrap();
    assert!(scan.whole, "{}", path.display());
    let topics = scan.contents.channels().map(|info| info.channel.topic);
    topics.map(|topic| (topic.clone(), scan.contents.messages(&topic))).collect()
}

#[test]
fn a_robot_goes_on_in_file_after_file_and_each_stands_alone() {
    _ = std::fs::remove_dir_all(folder("rotated", ""));
    let folder = folder("rotated", &two());
    record(&folder, "whole.mcap", &[]);
    let said = record(&folder, "part.mcap", &["--rotate", "1s", "--ros2", "--view", "--port", "0"]);
    let names = (1..).map(|number| match number {
        1 => "part.mcap".to_string(),
        number => format!("part-{number:04}.mcap"),
    });
    let files: Vec<PathBuf> = names.map(|name| folder.join(name)).take_while(|path| path.exists()).collect();
    assert!((3..=4).contains(&files.len()), "{files:?}");
    assert!(said.contains(&format!(", {} files", files.len())), "{said}");
    for board in BOARDS {
        let whole = images(&folder.join("whole.mcap"), board);
        let parts: Vec<_> = files.iter().map(|file| images(file, board)).collect();
        assert!(parts.iter().all(|part| part.first().is_some_and(|(_, pixels)| pixels.is_some())), "{board}");
        let parts: Vec<_> = parts.into_iter().flatten().collect();
        assert!(parts == whole && whole.len() > 500, "{board}: {} of {} images", parts.len(), whole.len());
    }
    let whole = counted(&folder.join("whole.mcap"));
    let sum =
        |topic: &str| files.iter().map(|file| counted(file).get(topic).copied().unwrap_or(0)).sum::<u64>();
    for board in BOARDS {
        for topic in ["frames", "contacts", "intent", "health"] {
            let topic = format!("/taxel/{board}/{topic}");
            assert_eq!(sum(&topic), whole[&topic], "{topic}");
        }
        let frames: u64 = files
            .iter()
            .map(|file| {
                let words = Overview::of(file).unwrap();
                let tally = words.words(&format!("{board}/{COUNTS}")).and_then(Tally::read).unwrap();
                assert_eq!((tally.lost, tally.undecoded, tally.refused), (0, 0, 0));
                tally.frames
            })
            .sum();
        assert_eq!(frames, whole[&format!("/taxel/{board}/frames")], "{board}");
    }
    for file in &files {
        let overview = Overview::of(file).unwrap();
        assert_eq!(overview.attached("robot.toml").unwrap().unwrap(), two().as_bytes());
        let beside = counted(&file.with_extension("ros2.mcap"));
        let [torso, hand] = ["/torso/tactile/chest/image", "/hand/tactile/mat/image"];
        let [of_torso, of_hand] = BOARDS.map(|board| counted(file)[&format!("/taxel/{board}/frames")]);
        assert_eq!((beside[torso], beside[hand]), (of_torso, of_hand), "{beside:?}");
        assert!(beside.contains_key("/tf_static"), "{beside:?}");
    }
}

#[test]
fn a_number_of_images_is_of_each_board() {
    let folder = folder("counted", &two());
    record(&folder, "few.mcap", &["--frames", "20"]);
    for board in BOARDS {
        assert_eq!(images(&folder.join("few.mcap"), board).len(), 20, "{board}");
    }
    let lines = ["live", "robot.toml", "--json", "--frames", "7"];
    let lines = Command::new(taxel()).current_dir(&folder).args(lines).output().unwrap();
    let lines = String::from_utf8(lines.stdout).unwrap();
    let frames = |board: &str| {
        let lines = lines.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        lines.filter(|line| line["board"] == board && line["type"] == "frame").count()
    };
    assert_eq!(BOARDS.map(frames), [7; 2]);
}

#[test]
fn options_are_those_of_every_board() {
    let board =
        |name: &str, more: &str| format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:pat\"\n{more}");
    let keys = "garment = \"reference\"\nbody = \"reference\"\ngestures = \"intent\"\nshapes = \"drawn\"\n";
    let robot = |more: &str| format!("name = \"two\"\n{}{}", board("left", more), board("right", more));
    let live = |folder: &Path, more: &[&str]| {
        let args = ["live", "robot.toml", "--json", "--for", "1.4s"];
        let done = Command::new(taxel()).current_dir(folder).args(args).args(more).output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
        for line in String::from_utf8(done.stdout).unwrap().lines() {
            let line: Value = serde_json::from_str(line).unwrap();
            *kinds.entry(format!("{} {}", line["board"], line["type"])).or_default() += 1;
        }
        kinds
    };
    let options =
        ["--garment", "reference", "--body", "reference", "--gestures", "intent", "--shapes", "drawn"];
    let printed = live(&folder("options", &robot("")), &options);
    let keyed = live(&folder("keys", &robot(keys)), &[]);
    assert!(printed.keys().eq(keyed.keys()), "{printed:?} {keyed:?}");
    for board in ["left", "right"] {
        for kind in ["pressing", "gesture", "shapes"] {
            assert!(printed.contains_key(&format!("\"{board}\" \"{kind}\"")), "{board}: {printed:?}");
        }
    }
}
