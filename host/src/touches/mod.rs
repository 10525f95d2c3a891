//! Learning from recorded touches: examples, a model that fits the board, what it is compared with, and the report.

mod command;
mod compare;
mod data;
mod export;
mod knn;
mod map;
mod model;
mod nested;
mod report;
mod ridge;
mod table;

pub use command::{EvalArgs, Files, Task, TrainArgs, grid, labels};
pub use compare::{Times, cross};
pub use data::{Data, Source, Touch};
pub use export::{Head, export};
pub use model::{Provenance, Settings, apply, decide, train};
pub use report::{Outcome, Report, accuracy};
pub use ridge::Ridge;
pub use table::Table;

/// Cards of the models that ship.
pub const CARDS: &str = include_str!("../../../docs/models.md");
