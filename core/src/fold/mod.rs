//! Self-interference: where the garment folds at a joint, it presses on its own taxels. What the folds press
//! is learned, expected at the present posture, and subtracted before contacts are found.
//!
//! | | |
//! |---|---|
//! | input | [`Posture`] messages; a [`FoldTable`] of the taxels that fold, in place (in flash) |
//! | output | expected pressure and doubt of each of these taxels, counts, see [`FoldState`] |
//! | saturation | an expectation ends at 255 of the table's units, a correction at 127 |
//! | latency | 20 ms: all taxels that fold are renewed in turn in this time |
//! | RAM | [`PostureState`]: 96 bytes; [`FoldState`]: 12,896 bytes |
//! | M0+ cycles | row `folds` of `docs/evidence/bench/cycles.txt` |
//!
//! The table has a *fold* for each joint, or pair of joints, that folds the garment: its taxels, and for each
//! of them what it feels at some angles, the knots. Between knots the expectation is linear. A sleeve follows
//! its joint only after some turn back: the angle plays between two stops that the joint drags along
//! (Prandtl's play operator).
//!
//! A taxel is touched if it feels more than it is expected to, by more than the doubt and the scene's floor;
//! beside a contact, by more than the floor. Its pressure is then what it feels less what it is expected to
//! feel: a touch stronger than the doubt is never hidden, and is felt as a whole. The doubt is what the
//! learner saw the taxel differ by on one day, and, until corrections are made, what it may differ by from
//! day to day.
//!
//! Corrections: whenever a joint comes to another knot, the taxels that nothing touches are compared once
//! with what is expected there. A taxel that is held against something at one posture therefore teaches
//! nothing more while it lasts, and what lies within three taxels of a contact teaches nothing at all. A tare
//! begins a new day.
//!
//! Without a posture, or with one older than [`STALE_US`], a fold may be anything: its taxels are touched
//! only beyond the most that they feel at any posture. The report of what is expected says so.

mod bend;
mod corners;
mod fours;
mod lanes;
mod lesson;
mod posture;
mod quads;
mod record;
mod stage;
mod table;

pub(crate) use fours::{consecutive, in_a_row};
pub(crate) use lanes::LevelPairs;
pub use posture::{JOINTS, JointAngle, Posture, PostureState, STALE_US};
pub use record::{FoldCell, FoldRecord, NO_JOINT, NO_TAXEL};
pub use stage::{Doubt, Expected, FoldState};
pub use table::{
    FoldTable, FoldTableParts, MOST_UNIT, fold_table_bytes, fold_table_length, write_fold_table,
};

/// Most taxels that fold, each fold's filled up to a multiple of four. None without the feature `folds`.
pub const FOLDED: usize = if cfg!(feature = "folds") { 512 } else { 0 };
/// Most cells of a table: taxels times knots.
pub const CELLS: usize = if cfg!(feature = "folds") { 8192 } else { 0 };
/// Most folds.
pub const FOLDS: usize = if cfg!(feature = "folds") { 8 } else { 0 };
/// Most knots of all folds together.
pub const KNOTS: usize = if cfg!(feature = "folds") { 256 } else { 0 };
