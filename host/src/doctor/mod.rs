//! `taxel doctor`: what a board tells in some seconds, judged: one verdict, with what to do.

mod command;
mod facts;
mod finding;
mod judge;

pub use command::{DoctorArgs, run};
pub use facts::Facts;
pub use finding::{Finding, Grade};
pub use judge::judge;
