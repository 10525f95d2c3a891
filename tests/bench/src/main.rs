//! `cargo xtask bench`: speed against error, as a text table, as JSON and as a chart.

#![forbid(unsafe_code)]

use anyhow::Result;
use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;
use taxel::files::output;
use taxel::text::words;
use taxel_bench::boards::{self, player};
use taxel_bench::{Report, acquisition, amplifier, mind, nmi, record, stages, tap};
use taxel_cli::fault;
use taxel_cli::watch::Overwrite;

/// Measure speed and error: tables and charts
#[derive(Debug, Clone, Parser)]
#[command(bin_name = "cargo xtask bench", args_conflicts_with_subcommands = true)]
struct BenchArgs {
    /// Which table; without it, `stages`
    #[command(subcommand)]
    table: Option<TableArg>,
    #[command(flatten)]
    output: Output,
}

#[derive(Debug, Clone, Subcommand)]
enum TableArg {
    /// Each stage and each variant: time on this machine, error, contacts
    #[command(after_help = "Example:\n  cargo xtask bench stages --svg stages.svg")]
    Stages(Output),
    /// Frames per second against the error of a taxel, over settling, source resistance, bits and averaging
    #[command(after_help = "Example:\n  cargo xtask bench acquisition --svg acquisition.svg")]
    Acquisition(Output),
    /// Settling of the garment's amplifier over its gain-bandwidth product
    #[command(after_help = "Example:\n  cargo xtask bench amplifier --json")]
    Amplifier(Output),
    /// Spread of the NMI and its forms under rotation, scale, shift and pressure
    #[command(after_help = "Example:\n  cargo xtask bench nmi --json")]
    Nmi(Output),
    /// Cost of recording beside perceiving, and speed of replay
    #[command(after_help = "Example:\n  cargo xtask bench record")]
    Record(record::RecordBench),
    /// Cost of recording a robot of 1 to 100 boards with a view open, played by other processes
    #[command(after_help = "Example:\n  cargo xtask bench boards --seconds 5 --long 0")]
    Boards(BoardsArgs),
    /// Play boards for `boards`
    #[command(hide = true)]
    Play(player::PlayArgs),
    /// Offer a simulated board, and keep its bytes, for `tests/zenoh`
    #[command(hide = true)]
    Tap(tap::TapArgs),
    /// Write the bytes of a recording, for `tests/zenoh`
    #[command(hide = true)]
    Wire(tap::WireArgs),
    /// Cost of the mind of a robot of 1 to 100 boards
    #[command(after_help = "Example:\n  cargo xtask bench mind")]
    Mind(mind::MindBench),
}

/// Options of `boards`.
#[derive(Debug, Clone, Args)]
struct BoardsArgs {
    #[command(flatten)]
    bench: boards::BoardsBench,
    #[command(flatten)]
    output: Output,
}

/// Options besides the text table.
#[derive(Debug, Clone, Args)]
struct Output {
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    /// Also draw the chart into this file
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    force: Overwrite,
}

fn main() -> ExitCode {
    match run(BenchArgs::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", words::sentence(error.as_ref()));
            ExitCode::from(fault::status(&error))
        }
    }
}

fn run(args: BenchArgs) -> Result<()> {
    match args.table.unwrap_or(TableArg::Stages(args.output)) {
        TableArg::Stages(output) => output.put(stages::report),
        TableArg::Acquisition(output) => output.put(|| Ok(acquisition::report())),
        TableArg::Amplifier(output) => output.put(|| Ok(amplifier::report())),
        TableArg::Nmi(output) => output.put(nmi::report),
        TableArg::Record(args) => record::run(&args),
        TableArg::Boards(BoardsArgs { bench, output }) => {
            let mut kept = Ok(());
            output.put(|| {
                let rows = boards::measure(&bench)?;
                kept = boards::keeps(&rows);
                Ok(boards::report(&rows))
            })?;
            kept
        }
        TableArg::Play(args) => player::run(&args),
        TableArg::Tap(args) => tap::run(&args),
        TableArg::Wire(args) => tap::wire(&args),
        TableArg::Mind(args) => mind::run(&args),
    }
}

impl Output {
    /// Prints a report, and draws its chart if a file is named; an output that cannot be written is refused
    /// before the work.
    fn put(&self, report: impl FnOnce() -> Result<Report>) -> Result<()> {
        let none: [&PathBuf; 0] = [];
        let chart = self.svg.as_ref().map(|file| output::Output::file(file, self.force, none)).transpose()?;
        let report = report()?;
        chart.map_or(Ok(()), |file| file.write(report.chart.svg().as_bytes()))?;
        if self.json {
            println!("{}", report.json);
        } else {
            print!("{}", report.text);
        }
        Ok(())
    }
}
