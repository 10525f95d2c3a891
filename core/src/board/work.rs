//! Work other than scanning, and the numbers of the requests that are answered when it is done.

use super::uploads::TableKind;
use crate::wire::Request;

/// Refusal of work.
pub const FULL: &str = "too much is waiting to be done";

/// Number of `Tare`, which is answered when it is done.
pub(super) const TARE: u8 = 2;

/// Work other than scanning, done between two scans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Work {
    SelfTest,
    Save,
    Reset { undo: bool },
    StoreTable,
    KeepTable(TableKind),
}

impl Work {
    /// Number of the request for it.
    pub fn request(self) -> u8 {
        match self {
            Work::SelfTest => Request::SelfTest.number(),
            Work::Save => Request::Save.number(),
            Work::Reset { .. } => Request::ResetSettings { undo: false }.number(),
            Work::KeepTable(TableKind::Folds) => Request::SetFolds(&[]).number(),
            Work::StoreTable | Work::KeepTable(TableKind::Surface) => Request::SetSurface(&[]).number(),
        }
    }
}
