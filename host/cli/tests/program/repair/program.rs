//! The command `taxel info --repair`.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// A test's folder, deleted at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("taxel-repair-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn run(&self, args: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).current_dir(&self.0).output().unwrap()
    }

    fn good(&self, args: &[&str]) -> String {
        let done = self.run(args);
        assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
        String::from_utf8(done.stdout).unwrap()
    }

    fn refused(&self, args: &[&str]) -> String {
        let done = self.run(args);
        assert!(!done.status.success(), "{args:?}");
        String::from_utf8(done.stderr).unwrap()
    }

    /// A recording of four seconds with a flipped bit in the n-th chunk's data.
    fn damaged(&self, name: &str, chunk: usize) -> Vec<u8> {
        self.good(&["record", "--source", "sim:press", "--for", "4s", "-o", name]);
        let place = &taxel::recording::chunk_indexes(&self.at(name)).unwrap()[chunk];
        let mut bytes = fs::read(self.at(name)).unwrap();
        bytes[(place.chunk_start_offset + place.chunk_length) as usize - 40] ^= 1;
        fs::write(self.at(name), &bytes).unwrap();
        bytes
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).unwrap();
    }
}

fn info(folder: &Folder, name: &str) -> serde_json::Value {
    serde_json::from_str(&folder.good(&["info", name, "--json"])).unwrap()
}

#[test]
fn a_repaired_recording_is_played_and_exported_and_the_damaged_one_stays() {
    let folder = Folder::new("played");
    let before = folder.damaged("touch.mcap", 2);
    let found = info(&folder, "touch.mcap");
    assert_eq!(found["whole"], false);
    assert_eq!(found["has_end"], true, "a file with a footer has its end");
    assert_eq!(found["damaged_chunks"], 1);
    assert!(!folder.good(&["info", "touch.mcap"]).contains("without its end"));

    folder.good(&["info", "touch.mcap", "--repair"]);
    assert!(fs::read(folder.at("touch.mcap")).unwrap() == before, "the damaged one stays");
    let repaired = info(&folder, "touch.repaired.mcap");
    assert_eq!(repaired["whole"], true);
    assert!(repaired["frames"].as_u64().unwrap() >= 50, "{repaired}");
    assert_eq!(repaired["frames"], found["frames"]);
    let played = folder.good(&["live", "touch.repaired.mcap@max", "--json"]);
    assert!(played.lines().count() > 50);
    folder.good(&["export", "touch.repaired.mcap", "--to", "npz", "-o", "touch.npz"]);
    assert!(folder.at("touch.npz").exists());
    let bytes = fs::read(folder.at("touch.repaired.mcap")).unwrap();
    assert!(mcap::read::LinearReader::new(&bytes).unwrap().all(|record| record.is_ok()));
}

#[test]
fn a_repair_takes_no_name_that_it_was_not_given() {
    let folder = Folder::new("names");
    let before = folder.damaged("touch.mcap", 2);
    fs::write(folder.at("touch.repaired.mcap"), "precious").unwrap();
    assert!(folder.refused(&["info", "touch.mcap", "--repair"]).contains("--force"));
    for name in ["touch.mcap", "./touch.mcap"] {
        let error = folder.refused(&["info", "touch.mcap", "--repair", "-o", name, "--force"]);
        assert!(error.contains("this command"), "{error}");
    }
    assert!(fs::read(folder.at("touch.mcap")).unwrap() == before);
    assert_eq!(fs::read(folder.at("touch.repaired.mcap")).unwrap(), b"precious");

    folder.good(&["info", "touch.mcap", "--repair", "--in-place"]);
    assert_eq!(info(&folder, "touch.mcap")["whole"], true);
    // An intact recording stays unchanged, and its copy is equal.
    let whole = fs::read(folder.at("touch.mcap")).unwrap();
    folder.good(&["info", "touch.mcap", "--repair", "--in-place"]);
    folder.good(&["info", "touch.mcap", "--repair", "-o", "copy.mcap"]);
    for name in ["touch.mcap", "copy.mcap"] {
        assert!(fs::read(folder.at(name)).unwrap() == whole, "{name}");
    }
    assert_eq!(fs::read_dir(&folder.0).unwrap().count(), 3, "nothing temporary is left");
}

#[test]
fn a_recording_without_its_first_chunk_is_played() {
    let folder = Folder::new("first");
    folder.good(&["record", "--source", "sim:press", "--for", "4s", "-o", "whole.mcap"]);
    let whole = info(&folder, "whole.mcap")["frames"].as_u64().unwrap();
    folder.damaged("touch.mcap", 0);
    folder.good(&["info", "touch.mcap", "--repair"]);
    for name in ["touch.mcap", "touch.repaired.mcap"] {
        let played = folder.good(&["live", &format!("{name}@max"), "--json"]);
        let lines: Vec<serde_json::Value> =
            played.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert_eq!(
            lines[0]["type"], "hello",
            "{name}: what the board is was reported in the chunk that is lost"
        );
        let decoded = lines.iter().filter(|line| line["decoded"] == true).count() as u64;
        assert!(decoded > 100 && decoded < whole, "{name}: {decoded} of {whole} frames");
        let npz = format!("{name}.npz");
        folder.good(&["export", name, "--to", "npz", "-o", &npz]);
        assert_eq!(
            taxel::files::arrays::read(&folder.at(&npz), Some("chest")).unwrap().count as u64,
            decoded
        );
    }
}
