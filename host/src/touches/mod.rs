//! Learning from recorded touches: examples, a model for the board, methods for comparison, and the report.

mod apply;
mod calibration;
mod certainty;
pub mod compare;
pub mod course;
mod data;
mod experts;
mod export;
mod files;
pub mod fitting;
pub mod gestures;
pub mod intent;
mod knn;
mod map;
pub mod model;
pub mod nested;
mod report;
mod ridge;
mod table;
mod windows;

pub use apply::{Applied, Taken, apply};
pub use compare::{Times, cross};
pub use course::Course;
pub use data::{Data, Source, Touch};
pub use experts::{Example, Trained};
pub use export::{Head, export};
pub use files::{Files, labels};
pub use model::{EARLY, Provenance, Settings, grid, train};
pub use report::{Outcome, Report, accuracy};
pub use ridge::Ridge;
pub use table::Table;
pub use windows::Windows;

/// Cards of the shipped models.
pub const CARDS: &str = include_str!("../../../docs/models.md");
