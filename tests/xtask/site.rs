//! `cargo xtask site`: the page of `taxel view` as a folder that any static server serves, and that needs no program.

use crate::cargo::cargo;
use crate::{paths, process};
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Target of the page's own board.
const TARGET: &str = "wasm32-unknown-unknown";
/// Files of the page, which the program serves, too.
const PAGE: &str = "host/cli/src/view/page";
/// Files that only the site has.
const OWN: &str = "host/site/page";
/// The module.
const MODULE: &str = "taxel.wasm";
/// What the page of the site has besides: its worker, boards on serial ports, and the policy that a program sends as a
/// header.
const WORKER: &str = "<html data-worker=\"worker.js\" ";
const POLICY: &str = "<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"\
    default-src 'self'; connect-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; \
    script-src 'self' 'wasm-unsafe-eval'; base-uri 'none'; form-action 'none'\">";
const SERIAL: &str = "<script type=\"module\" src=\"serial.js\"></script>\n</head>";
/// Lists the other files.
const KEEPER: &str = "service-worker.js";

/// Makes the site, and prints where and how large it is.
pub fn run() -> Result<(), String> {
    process::run(&mut build())?;
    let folder = assemble()?;
    let files = files(&folder)?;
    let bytes: usize = files.iter().map(|(_, content)| content.len()).sum();
    println!("{}: {} files, {} KiB", folder.display(), files.len(), bytes.div_ceil(1024));
    println!("python3 -m http.server --bind 127.0.0.1 --directory {}", folder.display());
    Ok(())
}

/// Makes the site for a check.
pub fn make(log: &Path) -> Result<PathBuf, String> {
    process::run_into(&mut build(), log)?;
    assemble()
}

/// The build of the module. rustup is asked for the target; a compiler without rustup has it, or says that it is missing.
fn build() -> Command {
    process::output(Command::new("rustup").args(["target", "add", TARGET]));
    cargo(&["build", "--release", "--locked", "--target", TARGET, "--package", "taxel-site"], paths::root())
}

/// Copies what was built, and the files of the page, into one folder.
fn assemble() -> Result<PathBuf, String> {
    let folder = paths::target().join("site");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let module = paths::target().join(TARGET).join("release/taxel_site.wasm");
    let mut all = vec![(MODULE.to_string(), read(&module)?)];
    all.extend(files(&paths::root().join(PAGE))?);
    all.extend(files(&paths::root().join(OWN))?);
    all.retain(|(name, _)| !name.ends_with(".ts"));
    all.sort();
    let mut version = DefaultHasher::new();
    all.iter().for_each(|(name, content)| {
        version.write(name.as_bytes());
        version.write(content);
    });
    let version = format!("taxel-{:016x}", version.finish());
    let names: Vec<_> = all.iter().map(|(name, _)| format!("\"{name}\"")).collect();
    for (name, content) in all {
        let content = match name.as_str() {
            "index.html" => {
                let page = replaced(content, "<html ", WORKER)?;
                let page = replaced(page, "<meta charset=\"utf-8\">", POLICY)?;
                replaced(page, "</head>", SERIAL)?
            }
            KEEPER => {
                let listed = replaced(content, "\"%FILES%\"", &format!("\"./\", {}", names.join(", ")))?;
                replaced(listed, "%VERSION%", &version)?
            }
            _ => content,
        };
        let path = folder.join(name);
        std::fs::write(&path, content).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(folder)
}

/// A text with one of its words replaced. Error if it lacks that.
fn replaced(text: Vec<u8>, word: &str, by: &str) -> Result<Vec<u8>, String> {
    let text = String::from_utf8(text).map_err(|_| format!("a file of the page with {word} is no text"))?;
    if text.contains(word) {
        Ok(text.replacen(word, by, 1).into())
    } else {
        Err(format!("no file has {word}"))
    }
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Names and contents of the files of a folder.
fn files(folder: &Path) -> Result<Vec<(String, Vec<u8>)>, String> {
    let listed = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let file = |entry: std::fs::DirEntry| {
        Ok((entry.file_name().to_string_lossy().into_owned(), read(&entry.path())?))
    };
    listed.flatten().map(file).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_into_the_files_has_its_place_there() {
        let page = read(&paths::root().join(PAGE).join("index.html")).unwrap();
        let page = String::from_utf8(replaced(page, "<html ", WORKER).unwrap());
        assert!(page.unwrap().contains("<html data-worker=\"worker.js\" lang=\"en\">"));
        let keeper = read(&paths::root().join(OWN).join(KEEPER)).unwrap();
        assert!(
            ["\"%FILES%\"", "%VERSION%"]
                .map(|word| replaced(keeper.clone(), word, ""))
                .iter()
                .all(Result::is_ok)
        );
        assert_eq!(replaced(b"a page".to_vec(), "%VERSION%", ""), Err("no file has %VERSION%".into()));
    }
}
