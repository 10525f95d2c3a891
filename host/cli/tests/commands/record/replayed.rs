//! Plays a recording.

use super::stage::{Seen, play};
use std::path::Path;

/// Contents of a recording.
pub fn replayed(path: &Path) -> Seen {
    let mut seen = Seen::default();
    play(&format!("replay:{}@max", path.display()), &mut seen);
    seen
}
