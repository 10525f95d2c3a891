//! The firmware and the fuzz targets have lock files of their own. The host tests must test what runs on the
//! board and what is fuzzed: all build the core from the same versions of the same crates.

use std::collections::{BTreeMap, BTreeSet};

/// The crate whose dependencies must agree.
const SHARED: &str = "taxel-core";

/// Name and version of a package in a lock file.
type Package<'a> = (&'a str, &'a str);

/// Compares the core's dependencies in the lock file of the root and that of a folder. Features may add
/// crates on one side; crates in both must have the same version.
pub fn compare(root: &str, other: &str, folder: &str) -> Result<(), String> {
    let (here, there) = (closure(root)?, closure(other)?);
    let versions = |name: &str| {
        let of_name = here.iter().filter(|(n, _)| *n == name);
        of_name.map(|(_, version)| version.to_string()).collect::<Vec<_>>().join(" and ")
    };
    let differ = there.difference(&here).filter(|(name, _)| !versions(name).is_empty());
    let differ: Vec<String> = differ
        .map(|(name, version)| format!("{name} ({} here, {version} in {folder})", versions(name)))
        .collect();
    if differ.is_empty() {
        Ok(())
    } else {
        Err(format!("the core's dependencies differ: {}", differ.join(", ")))
    }
}

/// All dependencies of the core.
fn closure(lock: &str) -> Result<BTreeSet<Package<'_>>, String> {
    let packages = packages(lock);
    let find = |name: &str, version: Option<&str>| {
        packages.keys().find(|(n, v)| *n == name && version.is_none_or(|version| *v == version)).copied()
    };
    let mut open = vec![find(SHARED, None).ok_or(format!("a lock file does not hold {SHARED}"))?];
    let mut found = BTreeSet::new();
    while let Some(package) = open.pop() {
        if !found.insert(package) {
            continue;
        }
        for dependency in &packages[&package] {
            // "name", or "name version" if the lock file has several.
            let mut words = dependency.split(' ');
            let name = words.next().unwrap_or_default();
            open.push(find(name, words.next()).ok_or(format!("a lock file does not hold {dependency}"))?);
        }
    }
    Ok(found)
}

/// All packages with their dependencies.
fn packages(lock: &str) -> BTreeMap<Package<'_>, Vec<&str>> {
    let mut found = BTreeMap::new();
    for entry in lock.split("[[package]]").skip(1) {
        let field = |key| entry.lines().find_map(|line| line.strip_prefix(key)?.strip_suffix('"'));
        let dependencies = entry.lines().filter_map(|line| line.strip_prefix(" \"")?.strip_suffix("\","));
        if let (Some(name), Some(version)) = (field("name = \""), field("version = \"")) {
            found.insert((name, version), dependencies.collect());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::compare;

    fn lock(packages: &[(&str, &str, &[&str])]) -> String {
        let entry = |(name, version, needs): &(&str, &str, &[&str])| {
            let needs: String = needs.iter().map(|need| format!(" \"{need}\",\n")).collect();
            format!("[[package]]\nname = \"{name}\"\nversion = \"{version}\"\ndependencies = [\n{needs}]\n\n")
        };
        format!("version = 4\n\n{}", packages.iter().map(entry).collect::<String>())
    }

    #[test]
    fn only_what_the_core_needs_counts() {
        let core = ("taxel-core", "0.1.0", ["crc", "syn 2.0.0"].as_slice());
        let (syn1, syn2): ((_, _, &[&str]), (_, _, &[&str])) = (("syn", "1.0.0", &[]), ("syn", "2.0.0", &[]));
        let root = lock(&[core, ("crc", "3.4.0", &[]), ("clap", "4.6.0", &["syn 1.0.0"]), syn1, syn2]);
        let plain = ("taxel-core", "0.1.0", ["crc", "syn"].as_slice());
        let compare = |other: &str| compare(&root, other, "firmware/");
        assert_eq!(compare(&lock(&[plain, ("crc", "3.4.0", &[]), ("clap", "3.0.0", &[]), syn2])), Ok(()));
        let message = compare(&lock(&[plain, ("crc", "3.3.0", &[]), syn2])).unwrap_err();
        assert_eq!(message, "the core's dependencies differ: crc (3.4.0 here, 3.3.0 in firmware/)");
        assert!(compare(&lock(&[])).is_err());
    }
}
