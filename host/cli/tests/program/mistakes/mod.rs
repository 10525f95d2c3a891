//! One mistake for each key of garment and scene files: each is refused with file, line and key. The keys are
//! those of the schemas, so that a key without a mistake fails the test.

mod garment;
mod keys;
mod scene;
mod touches;

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A mistake: key of the schema, text in the file, its replacement, and the error behind the file's name and
/// the line of the mistake.
type Mistake = (&'static str, &'static str, &'static str, &'static str);

/// A file with this text, in a folder of its own below the build folder, because tests run concurrently.
fn file(name: &str, text: &str) -> PathBuf {
    static FOLDERS: AtomicUsize = AtomicUsize::new(0);
    let folder = FOLDERS.fetch_add(1, Ordering::Relaxed).to_string();
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("mistakes").join(folder);
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a temporary file");
    path
}

/// Makes each mistake and compares the errors; reports all differences at the end.
fn each(base: &str, mistakes: &[Mistake], said: impl Fn(&str) -> String) {
    let mut wrong = Vec::new();
    for (key, from, to, expected) in mistakes {
        let at = base.find(from).unwrap_or_else(|| panic!("{key}: {from} is not in the file"));
        let text = base.replacen(from, to, 1);
        let before = from.bytes().zip(to.bytes()).take_while(|(a, b)| a == b).count();
        let line = text[..at + before].matches('\n').count() + 1;
        let said = said(&text);
        // The message about an unknown key names the key.
        let comma = if expected.starts_with(':') { "" } else { ", " };
        let expected = format!(", line {line}{comma}{expected}");
        if !said.contains(&expected) {
            wrong.push(format!("{key}: `{to}`\n     expected {expected}\n     is reported {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
