//! Pressure of the garment's folds on it, learned while joints move and nothing touches: a table for the board, see
//! [`taxel_core::fold`].
//!
//! | file | holds |
//! |---|---|
//! | `sweep.rs` | what the taxels felt on one day, and the joints' angles |
//! | `bend.rs` | where a fold's joints stood between its knots, frame by frame |
//! | `felt.rs` | a taxel's mean and spread at the knots, and how much of what it felt they explain |
//! | `near.rs` | the taxels that a shift of the garment may bring to where one lies |
//! | `learner.rs` | which taxels fold with which joints, and the table |
//! | `expected.rs` | what a table expects at a posture |
//!
//! Each taxel that was pressed belongs to the fold that explains it best. Its expectation is the mean over
//! the days, linear between knots; its spread covers all but a few frames of each day. From day to day a
//! garment shifts: a taxel may feel tomorrow what its neighbours feel today. The neighbours are therefore in
//! the table, too, and a taxel's spread is at least that of the taxels within half of the shift: a bulge that
//! appears at once does so elsewhere tomorrow.

mod bend;
mod expected;
mod felt;
mod learner;
mod near;
mod sweep;

pub use expected::expected;
pub use learner::{FoldSettings, LearnedFold, LearnedFolds, learn};
pub use sweep::FoldSweep;
