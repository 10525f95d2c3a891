//! A recording that is played.

use super::stage::{Seen, play};
use std::path::Path;

/// What a recording shows.
pub fn replayed(path: &Path) -> Seen {
    let mut seen = Seen::default();
    play(&format!("replay:{}@max", path.display()), &mut seen);
    seen
}
