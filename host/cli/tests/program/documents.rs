//! Lines of the shell in README and in the pages: each names a command, options, features and packages that exist.

use clap::Parser;
use clap::error::ErrorKind;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use taxel_cli::cli::Cli;

/// Commands, formats and sources that need a feature, and the feature.
const NEEDS: [(&str, &str); 4] =
    [("foxglove", "foxglove"), ("ros2", "ros2"), ("serve", "zenoh"), ("zenoh:", "zenoh")];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Pages that people read, each with its text.
fn pages() -> Vec<(String, String)> {
    let listed = |folder: &str| -> Vec<String> {
        let entries = fs::read_dir(root().join(folder)).unwrap();
        entries.map(|entry| format!("{folder}/{}", entry.unwrap().file_name().display())).collect()
    };
    let (kinds, docs): (Vec<_>, Vec<_>) =
        listed("docs").into_iter().partition(|path| root().join(path).is_dir());
    let docs = kinds.iter().flat_map(|kind| listed(kind)).chain(docs).collect::<Vec<_>>().into_iter();
    let others =
        ["", "host/python/", "host/python/lerobot/", "tests/physics/"].map(|at| format!("{at}README.md"));
    let top = ["CHANGELOG.md", "CONTRIBUTING.md"].map(String::from);
    let all = docs.chain(others).chain(top).filter(|page| page.ends_with(".md"));
    all.map(|page| (page.clone(), read(&page))).collect()
}

/// Words of a line of the shell up to its comment, without their quotes; `|` and `&&` are words.
fn words(line: &str) -> Vec<String> {
    let (mut words, mut quote, mut is_word) = (vec![String::new()], None, false);
    for sign in line.chars() {
        match (sign, quote) {
            (_, Some(end)) if sign == end => quote = None,
            ('"' | '\'', None) => (quote, is_word) = (Some(sign), true),
            ('#', None) if !is_word => break,
            (' ', None) if !is_word => {}
            (' ', None) => {
                words.push(String::new());
                is_word = false;
            }
            _ => {
                words.last_mut().unwrap().push(sign);
                is_word = true;
            }
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Commands in a page's blocks of the shell, as words.
fn commands(page: &str) -> Vec<Vec<String>> {
    let blocks = page.split("\n```").skip(1).step_by(2).filter_map(|block| block.strip_prefix("sh\n"));
    let lines = blocks.flat_map(str::lines).map(words);
    let parts = lines.flat_map(|line| {
        let parts = line.split(|word| word == "|" || word == "&&");
        parts.map(<[String]>::to_vec).collect::<Vec<_>>()
    });
    parts.collect()
}

/// Features of the command `taxel` that the Python package brings along.
fn features_of_wheel() -> BTreeSet<String> {
    let toml = |path: &str| -> toml::Table { toml::from_str(&read(path)).unwrap() };
    let (project, crate_) = (toml("host/python/pyproject.toml"), toml("host/python/Cargo.toml"));
    let asked = project["tool"]["maturin"].get("features").and_then(|list| list.as_array());
    let of =
        |feature: &toml::Value| crate_["features"][feature.as_str().unwrap()].as_array().unwrap().clone();
    let all = asked.into_iter().flatten().flat_map(of);
    all.filter_map(|part| Some(part.as_str()?.strip_prefix("taxel-cli/")?.to_string())).collect()
}

/// What is wrong with the arguments of the program, in a build with these features.
fn wrong(args: &[String], features: &BTreeSet<String>) -> Option<String> {
    let needs = NEEDS.iter().filter(|(word, _)| {
        args.iter().any(|arg| arg == word || word.ends_with(':') && arg.starts_with(word))
    });
    if let Some((_, feature)) = needs.into_iter().find(|(_, feature)| !features.contains(*feature)) {
        return Some(format!("it needs the feature {feature}"));
    }
    let parsed = Cli::try_parse_from([&["taxel".to_string()], args].concat()).err()?;
    let asks = [ErrorKind::DisplayHelp, ErrorKind::DisplayVersion].contains(&parsed.kind());
    (!asks).then(|| parsed.to_string())
}

/// What is wrong with the arguments of `cargo run`.
fn wrong_run(args: &[String]) -> Option<String> {
    let at = args.iter().position(|word| word == "--");
    let (cargo, program) = (&args[..at.unwrap_or(args.len())], &args[at.map_or(args.len(), |at| at + 1)..]);
    let toml: toml::Table = toml::from_str(&read("host/cli/Cargo.toml")).unwrap();
    let mut features = BTreeSet::new();
    let mut cargo = cargo.iter();
    while let Some(option) = cargo.next() {
        match option.as_str() {
            "--release" => {}
            "--features" => features.extend(cargo.next()?.split(',').map(String::from)),
            _ => return Some(format!("{option} is no option of ours")),
        }
    }
    let missing = features.iter().find(|feature| toml["features"].get(feature.as_str()).is_none());
    missing.map(|feature| format!("there is no feature {feature}")).or_else(|| wrong(program, &features))
}

fn is_example(name: &str) -> bool {
    ["taxel", "cli"].iter().any(|at| root().join(format!("host/{at}/examples/{name}.rs")).is_file())
}

#[test]
fn every_command_that_a_page_names_exists() {
    let (wheel, mut count, mut all) = (features_of_wheel(), 0, Vec::new());
    for (page, text) in pages() {
        for command in commands(&text) {
            let words: Vec<&str> = command.iter().map(String::as_str).collect();
            let why = match words[..] {
                ["cargo", "run", "--release", "--example", name, ..] if is_example(name) => None,
                ["cargo", "run", ..] => wrong_run(&command[2..]),
                ["taxel", ..] => wrong(&command[1..], &wheel),
                ["cargo", "install", "--path", path, ..] if !root().join(path).is_dir() => {
                    Some("there is no such folder".into())
                }
                _ => continue,
            };
            count += 1;
            all.extend(why.map(|why| format!("{page}: {}: {why}", words.join(" "))));
        }
    }
    assert!(all.is_empty(), "{}", all.join("\n"));
    assert!(count > 100, "{count} commands");
}

/// Neither is in an index yet.
#[test]
fn no_page_installs_a_package_that_no_index_has() {
    let ours = ["taxel", "lerobot_robot_taxel", "lerobot-robot-taxel"];
    let mut count = 0;
    for (page, text) in pages() {
        for install in text.split("pip install ").skip(1) {
            let line = install.lines().next().unwrap_or_default();
            let line = line.split(['`', '#', '&']).next().unwrap_or_default();
            for word in line.split_whitespace() {
                let path = root().join(word);
                assert!(!ours.contains(&word), "{page}: pip install {line}: no index has {word}");
                let is_ours = word.starts_with("./") && !word.contains('*');
                assert!(!is_ours || path.join("pyproject.toml").is_file(), "{page}: {word}: no package");
                count += usize::from(is_ours);
            }
        }
    }
    assert!(count > 4, "{count} packages of ours");
}

#[test]
fn the_sketch_of_the_page_is_the_one_that_is_loaded() {
    let page = read("docs/guides/your-own-sensor.md");
    let shown =
        page.split("   ```cpp\n").nth(1).and_then(|rest| rest.split("   ```").next()).expect("a sketch");
    let shown: String =
        shown.lines().map(|line| format!("{}\n", line.strip_prefix("   ").unwrap())).collect();
    assert!(read("examples/arduino/tactile_mat/tactile_mat.ino").ends_with(&shown), "{shown}");
}
