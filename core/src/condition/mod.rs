//! From codes to pressure above the baseline: tare, calibration, floor, 3x3 filter, drift.
//!
//! | | |
//! |---|---|
//! | input | [`Code`] by taxel number; missing codes read as no pressure |
//! | output | [`Image`]: `u16` counts above the baseline by taxel number, and which rows may hold something |
//! | saturation | at 0 and at 65535 counts |
//! | latency | none |
//! | RAM | 11 bytes per taxel and 2,048 bytes |
//! | M0+ cycles | reference garment, 12 bit, with noise: 13 k where nothing touches (6 per taxel); 17 k with one contact of 29 taxels, 30 k with five; with texture on all 2,048 taxels 116 k (conservative), about 34 k more where gains are not 1 |
//!
//! A taxel's value is `((code - baseline) * gain + 2048) >> 12` with its gain in Q4.12, or `baseline - code` where
//! pressure lowers the code; a value below the floor is 0. The filter then works over the whole panel, across the seams of its blocks.
//!
//! Work follows what is touched. A quiet taxel is compared with a limit of its own, which is kept beside its baseline, and left;
//! what is beyond is calibrated and marked in [`Rows`], and only there the images are filtered and, one frame later, cleared or
//! overwritten. The result is that of the plain definition, bit for bit.
//!
//! Every row follows drift once in 345 ms, whatever the frame rate. What the untouched taxels of a panel agree on moves the baseline of all
//! of them, each by a factor of its own that is learnt; only what is slower than a touch does a taxel follow by itself. So a held contact
//! neither is swallowed nor drifts. Where drift and touch cannot be told apart the panel is [unsure](ConditionState::unsure).

mod calibrate;
mod certificate;
mod clamp;
mod clear;
mod common;
mod config;
mod conservative;
mod drift;
mod edge;
#[cfg(target_pointer_width = "64")]
mod eights;
mod factor;
mod feedback;
mod filter;
mod held;
mod image;
mod limit;
mod marks;
mod median;
mod own;
mod panel;
mod patches;
#[cfg(target_pointer_width = "64")]
mod plain;
mod progress;
mod rates;
mod row;
mod rows;
mod sampled;
mod sixteen;
mod slices;
mod spread;
mod square;
mod stage;
mod state;
mod tare;
mod taxels;
mod terms;
mod turn;
mod witness;

pub use certificate::Certificate;
pub use config::{ConditionConfig, Filter};
pub use edge::{Gradient, sobel};
pub(crate) use edge::{Neighbourhood, steepness_of_sixteens};
pub use feedback::{CARRIED, Feedback};
pub(crate) use held::Held;
pub use image::Image;
pub use progress::Tare;
pub use rows::Rows;
pub use sampled::Sampled;
pub(crate) use slices::{panel_of, row_of};
pub use stage::Condition;
pub use state::{ConditionState, UNITY};

#[cfg(doc)]
use crate::format::Code;
