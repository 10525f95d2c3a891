//! Figures of the docs, which recordings must give again.

use std::path::Path;

/// The workspace.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap()
}

/// Fails unless a file of the docs contains some words.
pub fn says(file: &str, words: &str) {
    let text = std::fs::read_to_string(root().join("docs").join(file)).unwrap();
    assert!(text.contains(words), "docs/{file} does not say: {words}");
}
