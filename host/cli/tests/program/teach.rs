//! A user teaches shapes, from outside: by touches with `taxel shapes learn` on a simulated board, then
//! `taxel live` with the base.

use crate::start::taxel;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A new empty folder.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("teach").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(taxel()).current_dir(folder).args(args).output().unwrap()
}

/// Standard output of a successful command, and its standard error.
fn done(folder: &Path, args: &[&str]) -> (String, String) {
    let Output { status, stdout, stderr } = run(folder, args);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let (out, err) = (text(stdout), text(stderr));
    assert!(status.success(), "{args:?}: {err}");
    (out, err)
}

/// A scene in which an object is held against back and chest, each time at another place, angle and force.
/// `draw` seeds the places.
fn scene(folder: &Path, name: &str, (shape, size_mm): (&str, [u32; 2]), draw: u32) {
    let touch = |n: u32| {
        let step = |of: u32| f64::from((n * 7 + draw * 5) % of) / f64::from(of);
        format!(
            "[[touch]]\npanel = \"{}\"\nshape = \"{shape}\"\nsize_mm = {size_mm:?}\nforce_n = {}\nat = [{}, {}]\n\
             angle_deg = {}\nstart_s = {}\nrise_s = 0.1\nhold_s = 0.3\nfall_s = 0.1\n",
            if n.is_multiple_of(2) { "back" } else { "chest" },
            15.0 + 10.0 * step(4),
            5.5 + 4.0 * step(9),
            9.0 + 13.0 * step(11),
            180.0 * step(13),
            0.3 + 0.9 * f64::from(n),
        )
    };
    let touches: String = (0..5).map(touch).collect();
    std::fs::write(folder.join(format!("{name}.toml")), format!("duration_s = 5\nseed = {draw}\n{touches}"))
        .unwrap();
}

/// Most frequent class of each contact of a scene, by a board that was taught.
fn answers(folder: &Path, scene: &str) -> Vec<String> {
    let source = format!("sim:{scene}.toml");
    let (lines, _) = done(folder, &["live", "--source", &source, "--shapes", "mine.json", "--json"]);
    let mut votes = BTreeMap::<u64, BTreeMap<String, u32>>::new();
    for line in lines.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()) {
        for contact in line["contacts"].as_array().filter(|_| line["type"] == "frame").into_iter().flatten() {
            let shape = contact["shape"].as_str().unwrap().to_string();
            *votes.entry(contact["id"].as_u64().unwrap()).or_default().entry(shape).or_default() += 1;
        }
    }
    let most = |votes: BTreeMap<String, u32>| votes.into_iter().max_by_key(|(_, count)| *count).unwrap().0;
    votes.into_values().map(most).collect()
}

#[test]
fn shapes_are_taught_by_touch_and_known_from_then_on() {
    let folder = folder("path");
    let things = [("box", [60, 40]), ("ball", [80, 80]), ("strap", [120, 20])];
    for thing in things {
        scene(&folder, thing.0, thing, 1);
        scene(&folder, &format!("other-{}", thing.0), thing, 2);
    }
    let learn = |name: &str| {
        let source = format!("sim:{name}.toml");
        done(&folder, &["shapes", "learn", name, "--source", &source, "-o", "mine.json"]).1
    };
    learn("box");
    let said = learn("ball");
    assert!(
        said.contains("\n5 of 5: held for 0.")
            && said.ends_with("100 % of 10 are recognised by the others\n"),
        "{said}"
    );
    let (list, _) = done(&folder, &["shapes", "list", "mine.json", "--json"]);
    let list: Value = serde_json::from_str(&list).unwrap();
    let class = |n: usize| {
        (list[0]["classes"][n]["name"].as_str().unwrap(), list[0]["classes"][n]["prototypes"].as_u64())
    };
    assert_eq!((class(0), class(1)), (("box", Some(5)), ("ball", Some(5))));
    for name in ["box", "ball"] {
        assert_eq!(answers(&folder, &format!("other-{name}")), vec![name; 5]);
    }
    assert_eq!(answers(&folder, "other-strap"), ["unknown"; 5], "nobody has taught it");
    learn("strap");
    for (name, _) in things {
        assert_eq!(answers(&folder, &format!("other-{name}")), vec![name; 5]);
    }
    let (printed, _) = done(&folder, &["shapes", "install", "mine.json", "--source", "sim:box.toml"]);
    assert_eq!(printed, "sim:box.toml knows 3 classes by 15 prototypes, until it restarts.\n");
    let (card, _) = done(&folder, &["shapes", "card", "mine.json"]);
    assert!(
        card.contains("5 touches of sim:strap.toml") && card.contains("each prototype left out in turn"),
        "{card}"
    );
}

#[test]
fn a_recording_teaches_what_its_board_would() {
    let folder = folder("recording");
    scene(&folder, "box", ("box", [60, 40]), 3);
    done(&folder, &["record", "--source", "sim:box.toml", "-o", "box.mcap"]);
    let prototypes = |source: &str, file: &str| {
        done(&folder, &["shapes", "learn", "box", "--source", source, "-o", file]);
        let base: Value = serde_json::from_slice(&std::fs::read(folder.join(file)).unwrap()).unwrap();
        (
            base["gallery"].clone(),
            base["trained_on"].as_array().unwrap().last().unwrap()["fingerprint"].clone(),
        )
    };
    let (live, recorded) =
        (prototypes("sim:box.toml", "live.json"), prototypes("replay:box.mcap@max", "recorded.json"));
    assert_eq!(live.0, recorded.0);
    assert!(live.1 == "" && recorded.1 != "", "a file is known again: {} {}", live.1, recorded.1);
}

#[test]
fn what_teaches_nothing_is_said_in_one_sentence() {
    let folder = folder("refused");
    let refused = |args: &[&str], why: &str| {
        let Output { status, stderr, .. } = run(&folder, args);
        let text = String::from_utf8(stderr).unwrap();
        assert!(!status.success() && text.lines().last().unwrap().contains(why), "{args:?}: {text}");
        assert!(!folder.join("x.json").exists());
    };
    let learn = |name| ["shapes", "learn", name, "--source", "sim:idle", "--for", "1s", "-o", "x.json"];
    refused(&learn("box"), "sim:idle ended before anything was held against it for half a second");
    let taps = ["shapes", "learn", "tap", "--source", "sim:pat", "-o", "x.json"];
    assert!(String::from_utf8(run(&folder, &taps).stderr).unwrap().contains("too short"));
    let long = ["shapes", "learn", "seventeen letters", "--source", "sim:box", "-o", "x.json"];
    refused(&long, "the name \"seventeen letters\" has 17 bytes, expected 1 to 16");
    let unknown = ["live", "--source", "sim:box", "--shapes", "no-such-base"];
    refused(&unknown, "there is no base \"no-such-base\"");
}
