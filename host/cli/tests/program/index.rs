//! `taxel index` from outside: a row for each board of each recording, none lost.

use super::robot::{folder, two};
use crate::start::taxel;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Output};

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(taxel()).current_dir(folder).args(args).output().unwrap()
}

fn done(folder: &Path, args: &[&str]) {
    let done = run(folder, args);
    assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
}

/// Rows by file and board, as texts by column.
fn rows(file: &Path) -> Vec<BTreeMap<String, Field>> {
    let reader = SerializedFileReader::new(File::open(file).unwrap()).unwrap();
    let rows = reader.get_row_iter(None).unwrap();
    rows.map(|row| row.unwrap().into_columns().into_iter().collect()).collect()
}

#[test]
fn every_board_of_every_recording_has_a_row_and_what_is_unreadable_says_so() {
    let folder = folder("index", &two());
    let all = folder.join("all");
    let _ = std::fs::remove_dir_all(&all);
    std::fs::create_dir_all(all.join("day one")).unwrap();
    done(&folder, &["record", "--source", "sim:lash", "-o", "all/day one/lash.mcap"]);
    done(
        &folder,
        &[
            "record",
            "--source",
            "sim:press",
            "--garment",
            "block-4x16",
            "-o",
            "all/press.mcap",
            "--seconds",
            "1",
        ],
    );
    done(&folder, &["record", "robot.toml", "-o", "all/robot.mcap", "--seconds", "1"]);
    let whole = std::fs::read(all.join("press.mcap")).unwrap();
    std::fs::write(all.join("cut.mcap"), &whole[..whole.len() - 100]).unwrap();
    std::fs::write(all.join("empty.mcap"), "").unwrap();
    std::fs::write(all.join("text.mcap"), "nothing of taxel, but some text that is longer than a head")
        .unwrap();
    std::fs::write(all.join("notes.txt"), "no recording").unwrap();
    std::fs::create_dir_all(all.join("folder.mcap")).unwrap();
    let told = run(&folder, &["index", "all", "-o", "index.parquet", "--force"]);
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    assert_eq!(String::from_utf8_lossy(&told.stdout), "index.parquet: 6 recordings, 7 rows\n");
    let said = String::from_utf8_lossy(&told.stderr);
    assert!(
        said.starts_with("2 of them cannot be read, see the column `error`; the first one: empty.mcap\n"),
        "{said}"
    );
    let rows = rows(&folder.join("index.parquet"));
    let text = |row: &BTreeMap<String, Field>, column: &str| match &row[column] {
        Field::Str(text) => Some(text.clone()),
        Field::Null => None,
        other => panic!("{column}: {other}"),
    };
    let count = |row: &BTreeMap<String, Field>, column: &str| match row[column] {
        Field::Long(count) => count,
        Field::TimestampMicros(us) => us,
        ref other => panic!("{column}: {other}"),
    };
    let files: Vec<_> = rows.iter().map(|row| (text(row, "file").unwrap(), text(row, "board"))).collect();
    let board = |name: &str| Some(name.to_string());
    let want = [
        ("cut.mcap", None),
        ("day one/lash.mcap", None),
        ("empty.mcap", None),
        ("press.mcap", None),
        ("robot.mcap", board("torso")),
        ("robot.mcap", board("hand")),
        ("text.mcap", None),
    ];
    assert_eq!(files, want.map(|(file, board)| (file.to_string(), board)));
    let [cut, lash, empty, press, torso, hand, other] = &rows[..] else { panic!("{}", rows.len()) };
    // What the recordings are, by what `info` and `live` say of them.
    let info = run(&folder, &["info", "all/day one/lash.mcap", "--json"]);
    let info: serde_json::Value = serde_json::from_slice(&info.stdout).unwrap();
    assert_eq!(info["frames"], count(lash, "frames"));
    for word in ["garment", "scene", "firmware", "source"] {
        assert_eq!(info["metadata"]["taxel"][word].as_str().map(String::from), text(lash, word), "{word}");
    }
    // Log times are those of frames, of which the last message tells.
    assert!(
        info["start_us"].as_i64().unwrap() <= count(lash, "start")
            && count(lash, "end") <= info["end_us"].as_i64().unwrap()
    );
    let live = run(&folder, &["live", "--source", "replay:all/day one/lash.mcap@max", "--json"]);
    let lines: Vec<serde_json::Value> = String::from_utf8(live.stdout)
        .unwrap()
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let onsets = lines
        .iter()
        .filter(|line| line["type"] == "contacts")
        .flat_map(|line| line["contacts"].as_array().unwrap());
    assert_eq!(onsets.filter(|contact| contact["phase"] == "onset").count() as i64, count(lash, "contacts"));
    let leading: Vec<&str> = lines
        .iter()
        .filter(|line| line["type"] == "intent")
        .map(|line| line["intent"]["leading"].as_str().unwrap())
        .collect();
    let attacks = leading
        .iter()
        .enumerate()
        .filter(|(at, word)| **word == "attack" && (*at == 0 || leading[at - 1] != "attack"));
    assert_eq!(attacks.count() as i64, count(lash, "attack"));
    assert!(count(lash, "attack") > 0 && count(lash, "contacts") > 0 && count(lash, "lost") == 0);
    assert_eq!(text(press, "garment"), board("block-4x16"));
    assert_eq!((&press["whole"], &cut["whole"]), (&Field::Bool(true), &Field::Bool(false)));
    assert_eq!(count(press, "frames"), count(cut, "frames"));
    assert_eq!((text(torso, "robot"), text(hand, "robot")), (board("two"), board("two")));
    assert_eq!((text(torso, "garment"), text(hand, "garment")), (board("reference"), board("block-4x16")));
    assert!(count(torso, "contacts") == 5 && count(hand, "contacts") > 0);
    for (row, why) in [(empty, "all/empty.mcap"), (other, "all/text.mcap")] {
        assert_eq!(
            (&row["frames"], &row["start"], &row["whole"]),
            (&Field::Null, &Field::Null, &Field::Null)
        );
        assert!(text(row, "error").unwrap().contains(why), "{:?}", row["error"]);
    }
    assert!(rows.iter().filter(|row| row["error"] == Field::Null).count() == 5);
}

#[test]
fn a_table_is_not_replaced_and_an_input_never_is() {
    let folder = folder("index-over", &two());
    done(&folder, &["record", "--source", "sim:press", "-o", "one.mcap", "--seconds", "0.3", "--force"]);
    std::fs::write(folder.join("old.parquet"), "old").unwrap();
    for (output, force, why) in [("old.parquet", "", "already exists"), ("one.mcap", "--force", "one.mcap")] {
        let args = ["index", ".", "-o", output, force];
        let told = run(&folder, &args[..if force.is_empty() { 4 } else { 5 }]);
        let said = String::from_utf8_lossy(&told.stderr);
        assert!(!told.status.success() && said.contains(why), "{said}");
    }
    assert_eq!(std::fs::read(folder.join("old.parquet")).unwrap(), b"old");
    let none = run(&folder, &["index", "no such folder", "-o", "index.parquet"]);
    assert!(
        none.status.code() == Some(1)
            && String::from_utf8_lossy(&none.stderr).contains("no such folder cannot be read")
    );
}

/// Recordings of a second of different scenes.
const SCENES: [&str; 5] = ["five", "lash", "pat", "press", "idle"];
/// Recordings that are indexed: the ordinary test, and a campaign.
const MANY: [usize; 2] = [40, 10_000];

/// How long it takes is printed.
#[test]
fn many_recordings_have_as_many_rows() {
    let many = MANY[usize::from(std::env::var_os("TAXEL_CAMPAIGN").is_some())];
    let folder = folder("index-many", &two());
    let all = folder.join("all");
    let _ = std::fs::remove_dir_all(&all);
    std::fs::create_dir_all(&all).unwrap();
    let made = SCENES.map(|scene| {
        let file = format!("{scene}.mcap");
        done(
            &folder,
            &["record", "--source", &format!("sim:{scene}"), "-o", &file, "--seconds", "1", "--force"],
        );
        folder.join(file)
    });
    for number in 0..many {
        let inside = all.join(format!("{:02}", number / 500));
        std::fs::create_dir_all(&inside).unwrap();
        // A file of its own, whose content is shared: 10,000 copies would fill disks.
        std::fs::hard_link(&made[number % made.len()], inside.join(format!("{number:05}.mcap"))).unwrap();
    }
    let bytes: u64 =
        (0..many).map(|number| std::fs::metadata(&made[number % made.len()]).unwrap().len()).sum();
    let begun = std::time::Instant::now();
    done(&folder, &["index", "all", "-o", "many.parquet", "--force"]);
    let seconds = begun.elapsed().as_secs_f64();
    let rows = rows(&folder.join("many.parquet"));
    assert_eq!(rows.len(), many);
    assert!(rows.iter().all(|row| row["error"] == Field::Null && row["whole"] == Field::Bool(true)));
    // Each file says what the first of its scene says.
    for (number, row) in rows.iter().enumerate() {
        let first = &rows[number % made.len()];
        assert!(row.iter().all(|(column, value)| column == "file" || *value == first[column]), "{number}");
    }
    println!("{many} recordings of {:.0} MB: {seconds:.1} s", bytes as f64 / 1e6);
    std::fs::remove_dir_all(&all).unwrap();
}
