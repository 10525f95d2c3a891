//! The inputs that a fuzzer found worth keeping, and those that found a defect once: each holds what its target
//! says.

use std::fs;
use std::path::{Path, PathBuf};
use taxel_fuzz::TARGETS;

/// Bytes of all inputs together, at most: they are read by people who fetch the repository.
const MOST: u64 = 200 << 10;

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus")
}

/// The files of a folder, in the order of their names.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// Runs a target with each input of its corpus.
fn replay(name: &str) {
    let (_, target) = TARGETS.iter().find(|(known, _)| *known == name).expect("a target of that name");
    let inputs = files(&corpus().join(name));
    assert!(!inputs.is_empty(), "there are inputs");
    for input in inputs {
        println!("{}", input.display());
        target(&fs::read(&input).unwrap());
    }
    target(&[]);
}

macro_rules! replays {
    ($($name:ident),* $(,)?) => {
        $(#[test] fn $name() { replay(stringify!($name)); })*

        #[test]
        fn every_target_is_replayed_and_has_a_program_of_its_own() {
            let names = TARGETS.map(|(name, _)| name);
            assert_eq!(names, [$(stringify!($name)),*]);
            let stem = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
            let targets = files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("targets/src"));
            assert_eq!(targets.iter().map(stem).collect::<Vec<_>>(), names);
            assert_eq!(files(&corpus()).iter().map(stem).collect::<Vec<_>>(), names);
        }
    };
}

replays!(arrays, board, client, network, page, recording, robots, store, streams, texts);

#[test]
fn the_inputs_are_small() {
    let inputs: Vec<PathBuf> = files(&corpus()).iter().flat_map(|folder| files(folder)).collect();
    let bytes: u64 = inputs.iter().map(|input| fs::metadata(input).unwrap().len()).sum();
    assert!(bytes <= MOST, "{} inputs take {bytes} bytes", inputs.len());
}
