//! From codes to pressure above the baseline: tare, calibration, floor, 3x3 filter, drift.
//!
//! | | |
//! |---|---|
//! | input | [`Code`] by taxel number; missing codes read as no pressure |
//! | output | [`Image`]: `u16` counts above the baseline by taxel number, and the rows that may be non-zero |
//! | saturation | at 0 and at 65535 counts |
//! | latency | none; a point that presses a single taxel passes one frame later |
//! | RAM | [`ConditionState`] of 2,048 taxels: 34,696 bytes, a third of it for [folds](crate::fold) |
//! | M0+ cycles | 12 k where nothing touches, 15 k with a contact of 29 taxels, 28 k with five, 136 k at most |
//!
//! The cycles are of the reference garment, 12 bit, with noise; at most: with texture on all 2,048 taxels.
//! Gains other than 1 take about 34 k more there.
//!
//! A taxel's value is `((code - baseline) * gain + 2048) >> 12` with its gain in Q4.12. If pressure lowers
//! the code, the difference is `baseline - code`. A value below the floor is 0. The filter then works on the
//! whole panel, across the seams of its blocks.
//!
//! Cost grows with the touched area. Each taxel has a limit beside its baseline; one within its limit is
//! inactive and is only compared. Taxels beyond their limits are calibrated and marked in [`Rows`]. Only
//! there are the images filtered and, one frame later, cleared or overwritten. The result is that of the
//! plain definition, bit for bit.
//!
//! The shipped filter ([`Filter::Persistent`]) removes impulses of one frame on one taxel, and keeps pressure
//! that lasts. It stores no previous image, only the first [`POINTS`] taxels of a frame that exceed their
//! neighbours by more than noise.
//!
//! Each row follows drift once in 0.7 s, twice while its garment drifts fast, at any frame rate. Under a
//! contact the baseline moves with the drift on which the panel's witnesses agree, so that a held contact
//! neither vanishes nor drifts.

mod config;
mod stage;
mod state;
#[cfg(test)]
mod tests;

pub use crate::baseline::feedback::{CARRIED, Feedback, Pressed};
pub use crate::baseline::progress::Tare;
pub use crate::calibrate::certificate::Certificate;
pub use crate::calibrate::sampled::Sampled;
pub use crate::calibrate::scale::UNITY;
pub use crate::filter::kinds::Filter;
pub use crate::filter::points::{MARGIN, POINTS};
pub use crate::image::rows::Rows;
pub use crate::image::view::Image;
pub use config::ConditionConfig;
pub use stage::Condition;
pub use state::ConditionState;

#[cfg(doc)]
use crate::format::Code;
