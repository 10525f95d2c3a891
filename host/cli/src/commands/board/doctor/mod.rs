//! `taxel doctor`: observes a board for some seconds, and reports one verdict with remedies.

mod command;
mod facts;
mod finding;
mod judge;

pub use command::{DoctorArgs, Examined, examine, first_cure, line, run, worst};
pub use facts::Facts;
pub use finding::{Finding, Grade};
pub use judge::judge;
