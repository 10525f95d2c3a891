//! Requests that wait to be sent to a board, and streams beside its scene.

use super::scene_change::SceneChange;
use super::wanted::Sets;

/// A request that is held back until the board has answered others.
#[derive(Debug, Clone)]
pub(super) enum HeldRequest {
    /// Frame of the wire, and what it sets.
    Frame(Vec<u8>, Option<Sets>),
    /// A change of the scene that is in force then.
    Change(SceneChange),
}

impl HeldRequest {
    /// True for a piece of a table.
    pub(crate) fn is_piece(&self) -> bool {
        matches!(self, HeldRequest::Frame(_, Some(sets)) if sets.is_piece())
    }
}

/// Streams beside a board's scene, until it restarts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Beside {
    pub raw_hz: u16,
    pub budget_hz: u16,
}

impl Default for Beside {
    fn default() -> Self {
        Beside { raw_hz: 0, budget_hz: 1 }
    }
}
