//! Messages about features that are not built in, and completions for shells.

use std::process::{Command, Output};

fn taxel(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).output().unwrap()
}

#[test]
#[cfg(not(feature = "foxglove"))]
fn a_build_without_foxglove_says_how_to_build_it() {
    let output = taxel(&["foxglove", "--source", "sim:pat", "--port", "0"]);
    let error = String::from_utf8(output.stderr).unwrap();
    let how = "`cargo run --release --features foxglove -- foxglove --source sim:pat --port 0`";
    assert!(output.status.code() == Some(2) && error.contains(how), "{error}");
}

#[test]
#[cfg(not(feature = "ros2"))]
fn a_build_without_ros2_says_how_to_build_it() {
    for words in ["ros2 --source sim:pat", "ros2 robot.toml --domain 7"] {
        let output = taxel(&Vec::from_iter(words.split(' ')));
        let error = String::from_utf8(output.stderr).unwrap();
        let how = format!("`cargo run --release --features ros2 -- {words}`");
        assert!(output.status.code() == Some(2) && error.contains(&how), "{error}");
    }
}

#[test]
#[cfg(not(feature = "zenoh"))]
fn a_build_without_zenoh_says_how_to_build_it() {
    for words in ["serve --source sim:pat --name arm/left", "serve robot.toml"] {
        let output = taxel(&Vec::from_iter(words.split(' ')));
        let error = String::from_utf8(output.stderr).unwrap();
        let how = format!("`cargo run --release --features zenoh -- {words}`");
        assert!(output.status.code() == Some(2) && error.contains(&how), "{error}");
    }
    let output = taxel(&["live", "--source", "zenoh:arm/left"]);
    let error = String::from_utf8(output.stderr).unwrap();
    let why = "source zenoh:arm/left: this program was built without Zenoh (feature `zenoh`)";
    assert!(output.status.code() == Some(2) && error.contains(why), "{error}");
}

#[test]
fn shells_complete_subcommands_and_options() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = taxel(&["completions", shell]);
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && text.contains("taxel"), "{shell}");
        for word in ["live", "calibrate", "foxglove", "ros2", "serve", "garment", "verbose"] {
            assert!(text.contains(word), "{shell}: {word}");
        }
    }
    let wrong = taxel(&["completions", "basch"]);
    assert_eq!(wrong.status.code(), Some(2));
}
