//! The images that leave something out: `firmware/Cargo.toml` lists what may be.

use crate::cross::{TARGET, Toolchain};
use crate::end::End;
use crate::{firmware, paths, process};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// All features of the firmware but `bench`.
pub const ALL: [&str; 7] = ["folds", "gallery", "gesture", "intent", "raw", "reflex", "surface"];
/// Name of the image with all of them, and of that without any.
const EVERYTHING: &str = "everything";
const ALONE: &str = "contacts alone";
/// Name of the image that knows nothing of a robot's body, and what it leaves out.
const BODILESS: (&str, [&str; 2]) = ("without folds and surface", ["folds", "surface"]);
/// Limits of flash and RAM of some, KiB.
const MOST: [(&str, [u64; 2]); 3] = [(EVERYTHING, [394, 198]), (BODILESS.0, [360, 190]), (ALONE, [268, 152])];
/// Heading of the table.
const IMAGE: &str = "image";

/// The images of the table, by what they have.
fn images() -> Vec<(String, Vec<&'static str>)> {
    let rest = |left: &[&str]| ALL.into_iter().filter(|feature| !left.contains(feature)).collect();
    let some = [
        (EVERYTHING.into(), ALL.to_vec()),
        (BODILESS.0.into(), rest(&BODILESS.1)),
        (ALONE.into(), Vec::new()),
    ];
    some.into_iter().chain(ALL.iter().map(|left| (format!("without {left}"), rest(&[left])))).collect()
}

/// Adds the features to a command that compiles or builds.
fn with(mut command: Command, features: &[&str]) -> Command {
    command.args(["--locked", "--no-default-features", "--features"]).arg(features.join(","));
    command
}

/// The command that builds an image with these features.
pub fn image(toolchain: &Toolchain, features: &[&str]) -> Command {
    let mut build = toolchain.cargo("build", &paths::firmware());
    build.args(["--bin", "taxel-firmware"]);
    with(build, features)
}

/// A folder of their own, so that the image that ships stays.
fn folder(toolchain: &Toolchain) -> PathBuf {
    toolchain.folder().join("features")
}

/// Builds an image; returns its flash and RAM, bytes. Error if they exceed its limits.
fn build(toolchain: &Toolchain, name: &str, features: &[&str], log: &Path) -> Result<[u64; 2], String> {
    let named = |error| format!("{name}: {error}");
    let mut build = image(toolchain, features);
    process::run_into(build.env("CARGO_TARGET_DIR", folder(toolchain)), log).map_err(named)?;
    let elf = folder(toolchain).join(TARGET).join("release/taxel-firmware");
    let [flash, ram] = firmware::sizes_of(&elf).map_err(named)?;
    let most = MOST.into_iter().find(|(image, _)| *image == name);
    match most.filter(|(_, most)| exceeds([flash, ram], *most)) {
        Some((_, most)) => {
            Err(named(format!("flash {flash}, RAM {ram}, at most {} and {} KiB", most[0], most[1])))
        }
        None => Ok([flash, ram]),
    }
}

/// Builds every image, and returns the table of their sizes. Error if one exceeds its limits.
pub fn table(log: &Path) -> Result<String, String> {
    let toolchain = Toolchain::find()?;
    let mut text = format!("{IMAGE:<60}{:>10}{:>10}\n", "flash", "RAM");
    for (name, features) in images() {
        let [flash, ram] = build(&toolchain, &name, &features, log)?;
        let _ = writeln!(text, "{name:<60}{flash:>10}{ram:>10}");
    }
    Ok(text)
}

/// Sets of features in which each two of them are both in, both out, and one without the other. Beside an
/// empty one these are five: each feature is in three of them, no two in the same three.
fn paired() -> [Vec<&'static str>; 6] {
    const SETS: u8 = 5;
    let threes = (0..1_u8 << SETS).filter(|sets| sets.count_ones() == 3);
    let placed: Vec<_> = ALL.into_iter().zip(threes).collect();
    [0, 1, 2, 3, 4, SETS].map(|set| {
        placed.iter().filter(|(_, sets)| sets >> set & 1 == 1).map(|(feature, _)| *feature).collect()
    })
}

/// Compiles the core with all features and with these sets; [`table`] builds the images, which takes minutes.
/// The firmware only hands the features on.
pub fn check(log: &Path) -> End {
    let toolchain = Toolchain::find()?;
    Ok([ALL.to_vec()].iter().chain(&paired()).try_for_each(|features| {
        process::run_into(&mut with(firmware::core_command(&toolchain), features), log)
            .map_err(|error| format!("with the features {}: {error}", features.join(", ")))
    }))
}

/// True if bytes of flash or RAM exceed their limits, KiB.
fn exceeds(bytes: [u64; 2], most: [u64; 2]) -> bool {
    bytes.iter().zip(most).any(|(bytes, most)| *bytes > most * 1024)
}

#[cfg(test)]
mod tests {
    use super::{ALL, images, paired};

    /// The default features of a manifest.
    fn default_of(manifest: &str) -> Vec<&str> {
        let line = manifest.lines().find(|line| line.starts_with("default = "));
        line.map_or(Vec::new(), |line| line.split('"').skip(1).step_by(2).collect())
    }

    #[test]
    fn each_two_features_are_in_and_out_together_and_alone() {
        let sets = paired();
        assert!(sets[5].is_empty());
        for (at, one) in ALL.iter().enumerate() {
            for other in &ALL[at + 1..] {
                let mut met: Vec<_> =
                    sets.iter().map(|set| [set.contains(one), set.contains(other)]).collect();
                met.sort_unstable();
                met.dedup();
                assert_eq!(met.len(), 4, "{one} and {other}: {met:?}");
            }
        }
    }

    #[test]
    fn every_feature_has_an_image_without_it() {
        assert_eq!(default_of(include_str!("../../firmware/Cargo.toml")), ALL);
        assert_eq!(default_of(include_str!("../../core/Cargo.toml")), ALL);
        assert!(ALL.iter().all(|left| {
            images().iter().any(|(_, has)| has.len() == ALL.len() - 1 && !has.contains(left))
        }));
    }
}
