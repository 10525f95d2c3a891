//! From codes to pressure above the baseline: tare, calibration, floor, 3x3 filter, drift.
//!
//! | | |
//! |---|---|
//! | input | [`Code`] by taxel number; missing codes read as no pressure |
//! | output | [`Image`]: `u16` counts above the baseline by taxel number, and which rows may hold something |
//! | saturation | at 0 and at 65535 counts |
//! | latency | none |
//! | RAM | 8 bytes per taxel and 280 bytes |
//! | M0+ cycles | reference garment: 40 k where nothing touches (20 per taxel); 73 k with one contact of 29 taxels; 430 k (conservative), 500 k (median), 150 k (off) if all 2,048 taxels are touched |
//!
//! A taxel's value is `((code - baseline) * gain + 2048) >> 12` with its gain in Q4.12, or `baseline - code` where
//! pressure lowers the code; a value below the floor is 0. The filter then works over the whole panel, across the seams of its blocks.
//!
//! Work follows what is touched: a row without a code above the floor is compared and left, and filters and clearing
//! visit only rows that hold something or did so one frame ago.

mod calibrate;
mod clear;
mod config;
mod consensus;
mod conservative;
mod drift;
mod edge;
mod feedback;
mod filter;
mod image;
mod limit;
mod median;
mod progress;
mod rows;
mod stage;
mod state;
mod tare;

pub use config::{ConditionConfig, Filter};
pub(crate) use edge::Neighbourhood;
pub use edge::{Gradient, sobel};
pub use feedback::{CARRIED, Feedback};
pub use image::Image;
pub use progress::Tare;
pub use rows::Rows;
pub use stage::Condition;
pub use state::{ConditionState, UNITY};

#[cfg(doc)]
use crate::format::Code;
