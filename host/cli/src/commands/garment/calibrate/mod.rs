//! `taxel calibrate`: calibrates force with known weights, by a dialogue with the user; finds the settling time.

mod check;
mod command;
mod dialogue;
mod install;
mod operator;
pub mod settle;
pub mod steady;
mod task;

pub use command::{CalibrateArgs, run};
pub use install::install;
pub use operator::script;
pub use task::{CalibrationTask, calibrate};
