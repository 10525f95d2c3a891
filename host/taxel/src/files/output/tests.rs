//! Every name by which an input could be taken for an output, and what is left if writing fails.

use super::{Folder, Force, Output};
use crate::error::Result;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// A test's folder, deleted at its end. It has `in.mcap` and `old.csv`.
struct TestFolder(PathBuf);

impl TestFolder {
    fn new() -> TestFolder {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("taxel-writer-{}-{number}", std::process::id()));
        fs::create_dir_all(folder.join("sub")).unwrap();
        let scratch = TestFolder(folder);
        fs::write(scratch.at("in.mcap"), "recorded").unwrap();
        fs::write(scratch.at("old.csv"), "old").unwrap();
        scratch
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).unwrap()
    }

    /// Names in it, sorted.
    fn names(&self) -> Vec<String> {
        let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
        let mut names: Vec<_> = fs::read_dir(&self.0).unwrap().map(name).collect();
        names.sort();
        names
    }

    fn output(&self, name: &str, force: bool) -> Result<Output> {
        Output::file(&self.at(name), Force { force }, [self.at("in.mcap")])
    }

    fn refused(&self, name: &str, force: bool) -> String {
        format!("{:#}", self.output(name, force).unwrap_err())
    }
}

impl Drop for TestFolder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).unwrap();
    }
}

#[test]
fn an_input_is_no_output_by_any_spelling() {
    let scratch = TestFolder::new();
    let spellings = ["in.mcap", "./in.mcap", "sub/../in.mcap", "sub/.././/in.mcap"];
    for (name, force) in spellings.iter().flat_map(|name| [(name, false), (name, true)]) {
        let error = scratch.refused(name, force);
        assert!(error.contains("this command reads") || error.contains("read by this command"), "{error}");
    }
    assert_eq!(scratch.read("in.mcap"), "recorded");
}

#[cfg(unix)]
#[test]
fn an_input_is_no_output_by_any_link() {
    use std::os::unix::fs::symlink;
    let scratch = TestFolder::new();
    symlink("in.mcap", scratch.at("soft")).unwrap();
    symlink("soft", scratch.at("softer")).unwrap();
    symlink(&scratch.0, scratch.at("sub/up")).unwrap();
    fs::hard_link(scratch.at("in.mcap"), scratch.at("hard")).unwrap();
    for name in ["soft", "softer", "sub/up/in.mcap", "hard"] {
        let error = scratch.refused(name, true);
        assert!(error.contains("is the same file as") && error.contains("in.mcap"), "{error}");
    }
    symlink("nowhere", scratch.at("dangling")).unwrap();
    assert!(scratch.refused("dangling", true).contains("a link to a file that does not exist"));
    assert_eq!(scratch.read("in.mcap"), "recorded");
}

#[test]
fn what_is_no_file_name_is_refused_in_one_sentence() {
    let scratch = TestFolder::new();
    for (name, words) in [
        ("sub", "is a folder: name a file"),
        ("new/", "names no file"),
        ("none/new.csv", "cannot be written: the folder"),
        ("old.csv/new.csv", "cannot be written"),
        ("old.csv", "already exists: give another name, or --force"),
    ] {
        let error = scratch.refused(name, false);
        assert!(error.contains(words) && error.contains(name.trim_end_matches('/')), "{error}");
    }
    let none: [&Path; 0] = [];
    let standard = Output::file(Path::new("-"), Force::default(), none).unwrap_err().to_string();
    assert!(standard.starts_with("-o -:"), "{standard}");
    assert!(Output::stream(Path::new("-"), Force::default(), none).unwrap().is_standard());
    assert!(Output::stream(Path::new(""), Force::default(), none).is_err());
}

#[test]
fn another_file_is_replaced_only_with_force() {
    let scratch = TestFolder::new();
    scratch.output("old.csv", true).unwrap().write(b"new").unwrap();
    scratch.output("sub/../new.csv", false).unwrap().write(b"first").unwrap();
    assert_eq!((scratch.read("old.csv"), scratch.read("new.csv")), ("new".into(), "first".into()));
    assert_eq!(scratch.names(), ["in.mcap", "new.csv", "old.csv", "sub"]);
}

#[test]
fn what_is_not_kept_leaves_no_trace() {
    let scratch = TestFolder::new();
    let mut draft = scratch.output("old.csv", true).unwrap().draft().unwrap();
    draft.write_all(&[b'x'; 100_000]).unwrap();
    drop(draft);
    assert_eq!(scratch.read("old.csv"), "old");
    assert_eq!(scratch.names(), ["in.mcap", "old.csv", "sub"]);
}

#[test]
fn a_file_that_appears_meanwhile_is_not_replaced() {
    let scratch = TestFolder::new();
    let output = scratch.output("new.csv", false).unwrap();
    let begun = scratch.output("new.csv", false).unwrap();
    let mut draft = output.draft().unwrap();
    fs::write(scratch.at("new.csv"), "another's").unwrap();
    draft.write_all(b"ours").unwrap();
    let mut begun = begun.begin().unwrap().1;
    for error in [draft.keep().unwrap_err(), begun.name().unwrap_err()] {
        assert!(error.to_string().contains("already exists"), "{error}");
    }
    drop(begun);
    assert_eq!(scratch.read("new.csv"), "another's");
    assert_eq!(scratch.names(), ["in.mcap", "new.csv", "old.csv", "sub"]);
}

#[cfg(unix)]
#[test]
fn a_link_that_changes_meanwhile_does_not_lead_to_an_input() {
    use std::os::unix::fs::symlink;
    let scratch = TestFolder::new();
    symlink("old.csv", scratch.at("link")).unwrap();
    let (by_link, by_name) =
        (scratch.output("link", true).unwrap(), scratch.output("old.csv", true).unwrap());
    // The link leads to the input now; its old target is written.
    fs::remove_file(scratch.at("link")).unwrap();
    symlink("in.mcap", scratch.at("link")).unwrap();
    by_link.write(b"new").unwrap();
    assert_eq!((scratch.read("in.mcap"), scratch.read("old.csv")), ("recorded".into(), "new".into()));
    // The file itself has become the input.
    fs::remove_file(scratch.at("old.csv")).unwrap();
    fs::hard_link(scratch.at("in.mcap"), scratch.at("old.csv")).unwrap();
    let error = by_name.write(b"newer").unwrap_err().to_string();
    assert!(error.contains("is the same file as"), "{error}");
    assert_eq!(scratch.read("in.mcap"), "recorded");
}

#[test]
fn a_recording_has_its_name_once_it_is_begun() {
    let scratch = TestFolder::new();
    let begin = |name: &str, force: bool| scratch.output(name, force).unwrap().begin().unwrap();
    let ((mut new, mut new_begun), (mut file, mut begun)) =
        (begin("new.mcap", false), begin("old.csv", true));
    new.write_all(b"ha").unwrap();
    file.write_all(b"who").unwrap();
    assert_eq!(scratch.read("old.csv"), "old");
    assert!(!scratch.at("new.mcap").exists());
    new_begun.open().unwrap();
    begun.open().unwrap();
    assert_eq!((scratch.read("new.mcap"), scratch.read("old.csv")), ("ha".into(), "old".into()));
    let (_, mut empty) = begin("old.csv", true);
    assert!(empty.end(true).unwrap_err().to_string().ends_with("old.csv stays as it was: no frames came"));
    drop(empty);
    begun.name().unwrap();
    [new_begun, begun].iter_mut().for_each(|begun| begun.end(true).unwrap());
    new.write_all(b"lf").unwrap();
    file.write_all(b"le").unwrap();
    assert_eq!((scratch.read("new.mcap"), scratch.read("old.csv")), ("half".into(), "whole".into()));
    assert_eq!(scratch.names(), ["in.mcap", "new.mcap", "old.csv", "sub"]);
    assert!(scratch.refused("new.mcap", false).contains("--force"));
    drop(begin("other.mcap", false));
    assert_eq!(scratch.names(), ["in.mcap", "new.mcap", "old.csv", "sub"]);
}

#[cfg(unix)]
#[test]
fn modes_are_kept_and_read_only_files_are_left_alone() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = TestFolder::new();
    let mode =
        |mode: u32| fs::set_permissions(scratch.at("old.csv"), fs::Permissions::from_mode(mode)).unwrap();
    mode(0o640);
    scratch.output("old.csv", true).unwrap().write(b"new").unwrap();
    assert_eq!(fs::metadata(scratch.at("old.csv")).unwrap().permissions().mode() & 0o777, 0o640);
    mode(0o444);
    assert!(scratch.refused("old.csv", true).contains("is read-only"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_is_written_into_and_not_replaced() {
    let none: [&Path; 0] = [];
    let output = |name: &str| Output::file(Path::new(name), Force { force: true }, none).unwrap();
    output("/dev/null").write(b"gone").unwrap();
    let error = output("/dev/full").write(b"no room").unwrap_err().to_string();
    assert!(error.contains("/dev/full cannot be written") && error.contains("No space"), "{error}");
    for device in ["/dev/null", "/dev/full"] {
        assert!(!fs::metadata(device).unwrap().is_file(), "{device} is a device still");
    }
}

fn images(inside: &Path) -> bool {
    inside.extension().is_some_and(|extension| extension == "png")
}

#[test]
fn a_folder_gets_its_content_when_it_is_complete() {
    let scratch = TestFolder::new();
    let begin = |name: &str, force: bool| {
        Folder::begin(&scratch.at(name), Force { force }, [scratch.at("in.mcap")], images)
    };
    let write = |folder: &Folder, name: &str, text: &str| {
        folder.file(name).unwrap().write_all(text.as_bytes()).unwrap();
    };
    let half = begin("images", false).unwrap();
    write(&half, "left/1.png", "half");
    drop(half);
    assert!(!scratch.at("images").exists());
    for (force, number) in [(false, "1"), (true, "2")] {
        let folder = begin("images", force).unwrap();
        write(&folder, &format!("left/{number}.png"), number);
        folder.keep().unwrap();
    }
    assert!(!scratch.at("images/left/1.png").exists(), "no image of the export before");
    assert_eq!(scratch.read("images/left/2.png"), "2");
    assert_eq!(fs::read_dir(scratch.at("images")).unwrap().count(), 1, "nothing temporary is left");
    assert!(begin("images", false).unwrap_err().to_string().contains("--force"));
}

#[test]
fn a_folder_of_other_files_is_never_replaced() {
    let scratch = TestFolder::new();
    let begin = |name: &Path, force: bool| {
        let input = scratch.at("in.mcap");
        Folder::begin(name, Force { force }, [input], images).unwrap_err().to_string()
    };
    fs::write(scratch.at("sub/notes.txt"), "mine").unwrap();
    assert!(begin(&scratch.at("sub"), false).contains("is not empty"));
    assert!(begin(&scratch.at("sub"), true).contains("notes.txt"));
    assert!(begin(&scratch.0, true).contains("is the folder of"));
    assert!(begin(&scratch.at("old.csv"), true).contains("is a file: name a folder"));
    assert!(begin(Path::new("-"), true).starts_with("-o -:"));
    assert_eq!(scratch.read("sub/notes.txt"), "mine");
}
