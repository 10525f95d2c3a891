//! The command `taxel`.

use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs the command line behind the program's name, and returns its exit status.
#[pyfunction]
pub fn run_program(py: Python<'_>, words: Vec<OsString>) -> u8 {
    py.detach(|| taxel_cli::program::run(std::iter::once("taxel".into()).chain(words)))
}
