//! Arrays of others on a serial port: recorded and played.

use super::stage::{command, ended, folder, terminal};
use serde_json::Value;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// Keys of the array below.
const SOURCE: &str = "numbers:/dev/ttyMAT,rows=4,columns=6,range=0..1023";

/// Plugs in an array that sends lines of numbers, with a touch from the fortieth on, until this is true.
fn array(is_out: Arc<AtomicBool>) -> (JoinHandle<()>, String) {
    let (mut master, name) = terminal();
    let sends = move || {
        let mut frame = 0u32;
        while !is_out.load(Ordering::Relaxed) {
            let pressed = if frame > 40 { 500 } else { 0 };
            let value =
                |at: u32| 20 + (at + frame) % 3 + if matches!(at, 8..=9 | 14..=15) { pressed } else { 0 };
            let line = (0..24).map(|at| value(at).to_string()).collect::<Vec<_>>().join(",");
            let _ = master.write_all(format!("{line}\r\n").as_bytes());
            frame += 1;
            thread::sleep(Duration::from_millis(10));
        }
    };
    (thread::spawn(sends), name)
}

fn ports(name: &str) -> String {
    format!("[[port]]\nname = \"/dev/ttyMAT\"\nopens = \"{name}\"\n")
}

/// Lines of a type that a recording is printed as.
fn printed(folder: &Path, file: &str, kind: &str) -> Vec<Value> {
    let end = ended(command(folder, "", &["live", file, "--json"]));
    assert_eq!(end.status, Some(0), "{}", end.error);
    let lines = end.output.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    lines.filter(|line| line["type"] == kind).collect()
}

#[test]
fn an_array_is_recorded_and_played() {
    let here = folder("array");
    let is_out = Arc::new(AtomicBool::new(false));
    let (device, name) = array(Arc::clone(&is_out));
    let end =
        ended(command(&here, &ports(&name), &["record", "--source", SOURCE, "-o", "a.mcap", "--for", "2s"]));
    assert_eq!(end.status, Some(0), "{}", end.error);
    assert!(end.error.contains("numbers, 4 x 6, perceived by this host"), "{}", end.error);
    is_out.store(true, Ordering::Relaxed);
    device.join().unwrap();
    let hello = &printed(&here, "a.mcap", "hello")[0];
    assert_eq!((&hello["taxels"], &hello["simulated"]), (&Value::from(24), &Value::from(false)));
    assert!(hello["firmware"].as_str().unwrap().ends_with(" numbers"), "{hello}");
    let contacts = printed(&here, "a.mcap", "contacts");
    let felt =
        contacts.iter().find(|line| !line["contacts"].as_array().unwrap().is_empty()).expect("a touch");
    let [column, row] = ["column", "row"].map(|key| felt["contacts"][0][key].as_f64().unwrap());
    assert!((column - 2.5).abs() < 0.2 && (row - 1.5).abs() < 0.2, "{felt}");
}

#[test]
fn an_array_has_a_garment_and_is_examined_as_a_board_is() {
    let here = folder("array-examined");
    let is_out = Arc::new(AtomicBool::new(false));
    let (device, name) = array(Arc::clone(&is_out));
    let grid = "name = \"sole\"\n[grid]\nrows = 4\ncolumns = 6\npitch_um = [5000, 8000]\n";
    std::fs::write(here.join("sole.toml"), grid).unwrap();
    let words = ["live", "--source", SOURCE, "--garment", "sole.toml", "--json", "--frames", "20"];
    let end = ended(command(&here, &ports(&name), &words));
    assert!(
        end.status == Some(0) && end.output.contains("\"garment\":\"sole\""),
        "{}{}",
        end.output,
        end.error
    );
    let end = ended(command(&here, &ports(&name), &["health", "--source", SOURCE]));
    assert_eq!(end.status, Some(0), "{}{}", end.output, end.error);
    let end = ended(command(&here, &ports(&name), &["doctor", "--source", SOURCE]));
    assert!(
        end.output.contains("version      taxel-host ") && end.output.contains("It works"),
        "{}{}",
        end.output,
        end.error
    );
    is_out.store(true, Ordering::Relaxed);
    device.join().unwrap();
}

#[test]
fn a_wrong_key_is_reported_with_those_there_are() {
    let here = folder("array-wrong");
    for (source, why) in [
        ("flexitac:/dev/ttyMAT,row=3", "there is no key \"row\": did you mean \"rows\"?"),
        (
            "flexitac:/dev/ttyMAT",
            "serial port /dev/ttyMAT at 2000000 Bd cannot be opened: there is no such port",
        ),
        ("anyskin:/dev/ttyMAT", "this format states no range: add range=LOW..HIGH"),
    ] {
        let end = ended(command(&here, "", &["live", "--source", source]));
        assert!(end.status != Some(0) && end.error.contains(why), "{source}: {}", end.error);
    }
}
