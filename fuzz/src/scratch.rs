//! A file that is written anew for each input, for readers that take a path.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

/// Files of this process so far.
static FILES: AtomicU32 = AtomicU32::new(0);

/// A file that goes with this.
#[derive(Debug)]
pub struct Scratch(PathBuf);

impl Scratch {
    /// A file with this content, and with an ending that shows a reader its kind.
    pub fn new(content: &[u8], ending: &str) -> Scratch {
        let number = FILES.fetch_add(1, Ordering::Relaxed);
        let name = format!("taxel-fuzz-{}-{number}.{ending}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, content).expect("the folder for temporary files can be written");
        Scratch(path)
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Path of the folder, as text.
    pub fn name(&self) -> &str {
        self.0.to_str().expect("the folder for temporary files has a name in UTF-8")
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}
