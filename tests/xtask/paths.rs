//! Paths of the repository and of build products.

use std::path::{Path, PathBuf};

/// The repository: the one in which cargo runs this program, also if it was built in another place.
pub fn root() -> PathBuf {
    let tests = std::env::var_os("CARGO_MANIFEST_DIR");
    let tests = tests.map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).into(), PathBuf::from);
    tests.parent().expect("tests/ lies in the repository").to_path_buf()
}

/// The firmware's package.
pub fn firmware() -> PathBuf {
    root().join("firmware")
}

/// The fuzz targets.
pub fn fuzz() -> PathBuf {
    root().join("fuzz")
}

/// The peers.
pub fn peers() -> PathBuf {
    root().join("tests/peers")
}

/// Packages that are no members of the workspace and have a lock file each: their folders in the repository,
/// and where these are.
pub fn apart() -> [(&'static str, PathBuf); 3] {
    ["firmware", "fuzz/targets", "tests/peers"].map(|folder| (folder, root().join(folder)))
}

/// The emulator harness.
pub fn emulator() -> PathBuf {
    root().join("tests/emulator")
}

/// The browser tests of the page of `taxel view`.
pub fn browser() -> PathBuf {
    root().join("tests/browser")
}

/// Cargo's target folder.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// Target folder for the microcontroller, with a folder for each toolchain (see `cross`).
pub fn cross_target() -> PathBuf {
    target().join("firmware")
}

/// Log of a run, emptied.
pub fn log(name: &str) -> Result<PathBuf, String> {
    let folder = target().join("xtask");
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let log = folder.join(format!("{name}.log"));
    let _ = std::fs::remove_file(&log);
    Ok(log)
}

/// The pages of `docs`, by kind.
#[cfg(test)]
pub fn pages_of_docs() -> Vec<PathBuf> {
    let listed = |folder: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
    };
    let docs = listed(&root().join("docs"));
    let (kinds, top): (Vec<_>, Vec<_>) = docs.into_iter().partition(|path| path.is_dir());
    let mut pages: Vec<PathBuf> = kinds.iter().flat_map(|kind| listed(kind)).chain(top).collect();
    pages.retain(|path| path.extension().is_some_and(|end| end == "md"));
    pages
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Folders at the root whose files the docs name.
    const NAMED: [&str; 6] = ["core", "firmware", "host", "tests", "fuzz", "docs"];

    /// Words of a page between backticks that begin with a folder of the root. Placeholders are in capitals.
    fn named(page: &str) -> impl Iterator<Item = &str> {
        page.split('`').skip(1).step_by(2).filter(|word| {
            let folder = word.split('/').next().unwrap_or_default();
            let plain = word.chars().all(|sign| sign.is_alphanumeric() || "/._-".contains(sign));
            word.contains('/') && plain && NAMED.contains(&folder) && !word.contains(char::is_uppercase)
        })
    }

    #[test]
    fn the_files_that_the_docs_name_exist() {
        let top = ["README.md", "CONTRIBUTING.md"].map(|page| root().join(page));
        let pages: Vec<PathBuf> = pages_of_docs().into_iter().chain(top).collect();
        let mut count = 0;
        for page in &pages {
            for word in named(&fs::read_to_string(page).unwrap()) {
                assert!(root().join(word).exists(), "{}: there is no {word}", page.display());
                count += 1;
            }
        }
        assert!(pages.len() > 10 && count > 100, "{count} names on {} pages", pages.len());
    }
}
