//! The program `taxel-learn`.
#![forbid(unsafe_code)]

use clap::Parser;
use taxel_learn::commands::Cli;

fn main() -> anyhow::Result<()> {
    Cli::parse().run()
}
