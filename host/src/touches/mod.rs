//! Learning from recorded touches: examples, a model that fits the board, what it is compared with, and the report.

mod compare;
mod data;
mod date;
mod export;
mod knn;
mod map;
mod model;
mod report;
mod ridge;
mod table;

pub use compare::{Times, as_it_is, cross};
pub use data::{Data, Source, Touch};
pub use export::{Head, export};
pub use model::{Course, Settings, Shipped, apply, decide, read, train};
pub use report::{Outcome, Report, accuracy};
pub use ridge::Ridge;
pub use table::Table;
