//! `cargo xtask docs`: builds the pages of `docs/` as a book.

use crate::{install, paths, process};
use std::process::Command;

/// Version of mdBook.
const MDBOOK: &str = "0.5.4";
/// Its parts: without those that serve a book while it is written.
const PARTS: [&str; 3] = ["--no-default-features", "--features", "search"];

/// Builds the book, and prints where it begins.
pub fn run() -> Result<(), String> {
    let tool = install::cargo_tool_of("mdbook", MDBOOK, &PARTS).map_err(|why| format!("not run: {why}"))?;
    let (log, built) = (paths::log("docs")?, paths::target().join("docs"));
    let mut command = Command::new(tool);
    command.arg("build").arg(paths::root().join("docs")).arg("--dest-dir").arg(&built);
    process::run_into(&mut command, &log)?;
    println!("{}", built.join("index.html").display());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::path::PathBuf;

    /// The pages of the repository that people read, with their text.
    fn pages() -> Vec<(PathBuf, String)> {
        let top = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"]
            .map(|page| paths::root().join(page));
        let all = paths::pages_of_docs().into_iter().chain(top);
        all.map(|page| (page.clone(), fs::read_to_string(page).unwrap())).collect()
    }

    /// Lines of a page outside its blocks of code.
    fn prose(page: &str) -> impl Iterator<Item = &str> {
        page.split("\n```").step_by(2).flat_map(str::lines)
    }

    /// Targets of the links of a page that do not lead out of the repository.
    fn links(page: &str) -> Vec<&str> {
        let ends = prose(page).flat_map(|line| line.split("](").skip(1));
        let links = ends.filter_map(|end| Some(end.split_once(')')?.0));
        links.filter(|link| !link.contains("://")).collect()
    }

    /// The anchors of a page's headings, as GitHub and mdBook make them.
    fn anchors(page: &str) -> Vec<String> {
        let headings = prose(page).filter_map(|line| {
            Some(line.trim_start_matches('#').strip_prefix(' ')?).filter(|_| line.starts_with('#'))
        });
        let sign = |sign: char| match sign {
            ' ' => Some('-'),
            '-' | '_' => Some(sign),
            _ => sign.is_alphanumeric().then(|| sign.to_ascii_lowercase()),
        };
        headings.map(|heading| heading.chars().filter_map(sign).collect()).collect()
    }

    #[test]
    fn every_link_leads_somewhere() {
        let mut count = 0;
        for (path, page) in pages() {
            for link in links(&page) {
                let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
                let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
                let shown = format!("{}: {link}", path.display());
                assert!(target.exists(), "{shown}: there is no such file");
                if !anchor.is_empty() {
                    let page = fs::read_to_string(&target).unwrap();
                    assert!(anchors(&page).iter().any(|known| known == anchor), "{shown}: no such heading");
                }
                count += 1;
            }
        }
        assert!(count > 60, "{count} links");
    }

    #[test]
    fn the_book_holds_every_page() {
        let summary = fs::read_to_string(paths::root().join("docs/SUMMARY.md")).unwrap();
        let listed = links(&summary);
        let docs = paths::root().join("docs");
        let mut pages = paths::pages_of_docs();
        pages.retain(|path| !path.ends_with("SUMMARY.md"));
        for page in &pages {
            let name = page.strip_prefix(&docs).unwrap().to_str().unwrap();
            assert_eq!(listed.iter().filter(|link| **link == name).count(), 1, "{name} in docs/SUMMARY.md");
        }
        assert_eq!(pages.len(), listed.len());
    }

    /// What one reads from begin to end; a reference is looked up.
    #[test]
    fn no_page_to_read_is_long() {
        const MOST: usize = 1_800;
        for path in paths::pages_of_docs() {
            let page = fs::read_to_string(&path).unwrap();
            let words: usize = prose(&page).map(|line| line.split_whitespace().count()).sum();
            assert!(
                words <= MOST || path.parent().unwrap().ends_with("reference"),
                "{}: {words}",
                path.display()
            );
        }
    }

    /// The words behind each `cargo xtask`, in code or in prose.
    #[test]
    fn every_task_that_a_page_names_exists() {
        let mut count = 0;
        for (path, page) in pages() {
            for end in page.split("cargo xtask ").skip(1) {
                let word: String =
                    end.chars().take_while(|sign| sign.is_alphanumeric() || *sign == '-').collect();
                if word.is_empty() {
                    continue;
                }
                let listed = crate::USAGE.lines().filter_map(|line| line.trim().split(' ').next());
                assert!(
                    listed.into_iter().any(|task| task == word),
                    "{}: cargo xtask {word}",
                    path.display()
                );
                count += 1;
            }
        }
        assert!(count > 40, "{count} tasks");
    }

    /// What would have somebody ask an index for this software.
    const INDEXED: [&str; 8] = [
        "pip install taxel",
        "cargo install taxel",
        "cargo install --locked taxel",
        "cargo add taxel",
        "cargo binstall",
        "/project/taxel",
        "/crates/taxel",
        "docs.rs/taxel",
    ];
    /// The only section that may, until there is a tag.
    const LATER: &str = "## Once there is a release";

    /// Lines of a page that name an entry of an index which is not there.
    fn promised(page: &str) -> Vec<&str> {
        let now = page.split("\n## ").filter(|section| section.lines().next() != LATER.strip_prefix("## "));
        now.flat_map(str::lines).filter(|line| INDEXED.iter().any(|words| line.contains(words))).collect()
    }

    #[test]
    fn no_page_names_an_entry_of_an_index_that_is_not_there() {
        let line = "pip install taxel";
        assert_eq!(promised(&format!("# A\n{line}\n\n{LATER}\n{line}\n\n## B\n{line}\n")), [line, line]);
        let packages = ["core", "host/python", "host/python/lerobot"].map(|folder| {
            let page = paths::root().join(folder).join("README.md");
            (page.clone(), fs::read_to_string(page).unwrap())
        });
        let pages: Vec<_> = pages().into_iter().chain(packages).collect();
        for (path, page) in &pages {
            assert_eq!(promised(page), [""; 0], "{}", path.display());
        }
        assert!(pages.iter().any(|(_, page)| page.contains(LATER)));
    }

    #[test]
    fn the_changelog_is_short_and_has_this_version() {
        let page = fs::read_to_string(paths::root().join("CHANGELOG.md")).unwrap();
        let version = concat!("\n## ", env!("CARGO_PKG_VERSION"), "\n");
        let (_, section) = page.split_once(version).expect("this version");
        let lines = section.split("\n## ").next().unwrap().lines().count();
        assert!(lines <= 80, "{lines} lines");
    }

    /// The rule of Linux names the device that the library looks for.
    #[test]
    fn the_rule_for_linux_names_the_board() {
        let read = |path| fs::read_to_string(paths::root().join(path)).unwrap();
        let rule = read("examples/linux/70-taxel.rules");
        let word = |key: &str| rule.split_once(&format!("{key}}}==\"")).unwrap().1.split('"').next().unwrap();
        let (vendor, product, name) = (word("idVendor"), word("idProduct"), word("{product"));
        let board = format!("(0x{vendor}, 0x{product}, \"{}\")", name.trim_end_matches('*'));
        assert!(read("host/taxel/src/source/usb.rs").contains(&board), "{board}");
    }
}
