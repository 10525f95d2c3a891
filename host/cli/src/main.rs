//! The program `taxel`.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(taxel_cli::program::run(std::env::args_os()))
}
