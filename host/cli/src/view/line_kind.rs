//! Kinds of lines of the log.

use serde::Serialize;

/// Kind of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LineKind {
    /// A contact begins.
    Onset,
    /// A contact ends.
    Release,
    /// Another intention leads.
    Intention,
    /// A reaction of the garment begins or ends.
    Reaction,
    /// A gesture was recognised.
    Gesture,
    /// Messages or a part of a recording are missing.
    Gap,
    /// Everything else: garments, answers, log messages of the board.
    Note,
}
