//! The baseline: its tare, and its drift.
//!
//! [`tare`] takes the mean of some frames as the baseline and counts its [`progress`]. [`drift`] then moves
//! the rows in [`turn`], at the [`rates`] that hold for any garment, by the [`consensus`] of each panel's
//! witnesses, and by what they [missed](missed) under a contact. [`feedback`] names the contacts under which a
//! baseline stands still, [`touched`] the taxels beside them. [`tracking`] is the state of all this.

pub(crate) mod consensus;
pub(crate) mod drift;
pub(crate) mod feedback;
mod missed;
pub(crate) mod progress;
pub(crate) mod rates;
pub(crate) mod tare;
pub(crate) mod touched;
pub(crate) mod tracking;
pub(crate) mod turn;
