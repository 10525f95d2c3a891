//! Learning from recorded touches: examples, a model for the board, methods for comparison, and the report.

mod apply;
mod calibration;
mod certainty;
mod compare;
mod course;
mod data;
mod experts;
mod files;
mod fitting;
pub mod gestures;
pub mod intent;
mod knn;
mod map;
mod model;
mod nested;
mod report;
mod ridge;
mod settings;
mod table;
mod windows;

pub use apply::{Applied, Taken, apply};
pub use compare::{Times, as_it_is, cross, example};
pub use course::{Course, courses};
pub use data::{Data, Touch, TouchesFile};
pub use experts::{TouchExample, Trained};
pub use files::{Files, labels};
pub use fitting::{saturation, units};
pub use model::{Provenance, read, train};
pub use nested::nested;
pub use report::{Outcome, Report, accuracy};
pub use ridge::Ridge;
pub use settings::{EARLY, TrainSettings, grid};
pub use table::Table;
pub use windows::Windows;
