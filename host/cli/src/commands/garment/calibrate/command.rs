//! The command `taxel calibrate`.

use super::check::{self, CalibrationCheckArgs};
use super::settle::{self, SettleArgs};
use super::task::{CalibrationTask, calibrate};
use super::{install, operator};
use crate::fault::Fault;
use crate::watch::raw::RawBoard;
use crate::watch::{Overwrite, time};
use anyhow::{Result, bail, ensure};
use clap::{Args, Subcommand};
use serde_json::json;
use std::path::PathBuf;
use taxel::files::calibrate::{Calibration, OfWeight, Over, plates};
use taxel::files::output::Output;
use taxel::sim::Sensor;
use taxel::source::{self, SourceSpec};
use taxel_core::garment::Layout;
use taxel_core::wire::Request;

/// Newtons per kilogram-force.
const GRAVITY: f64 = 9.806_65;
/// Garment of a simulation if none is given.
const SIMULATED: &str = "block-4x16";
/// Properties of a simulated garment.
const SENSOR: Sensor = Sensor { gain_spread: 0.10, hysteresis: 0.03, noise: 0.02, half_n: 0.0 };

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel calibrate --simulate 7
  taxel calibrate --source usb --over block --weights 0.5,1,2,5,10 --kg --by Anna --save -o anna.toml
  taxel calibrate check anna.toml
  taxel calibrate settle --garment garment.toml -o settled.toml";

/// Calibrate force with known weights; find the settling time
#[derive(Debug, Clone, Args)]
#[command(args_conflicts_with_subcommands = true)]
#[command(after_help = EXAMPLES)]
pub struct CalibrateArgs {
    #[command(subcommand)]
    also: Option<Also>,
    /// The board: `auto`, `usb[:SERIAL]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// The garment, a preset or a TOML file [default: the board's]
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// Area that the plate under the weights covers
    #[arg(long, value_enum, default_value_t = Cover::Panel)]
    pub over: Cover,
    /// Weights with their plate, N, put on one after the other and taken off again
    /// [default: 5,10,20,50,100; over a taxel 0.2,0.5,1,2]
    #[arg(long, value_name = "N,N,...", value_delimiter = ',')]
    pub weights: Vec<f64>,
    /// Weights are in kg
    #[arg(long)]
    pub kg: bool,
    /// Who calibrates [default: the user's name]
    #[arg(long, value_name = "NAME")]
    pub by: Option<String>,
    /// Longest wait for a weight
    #[arg(long, value_name = "TIME", default_value = "2min", value_parser = time)]
    pub wait: f64,
    /// File to write
    #[arg(long, short, value_name = "FILE", default_value = "calibration.toml")]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Also save the calibration to the board's flash
    #[arg(long)]
    pub save: bool,
    /// Print the dialogue as JSON, one object per line
    #[arg(long)]
    pub json: bool,
    /// Simulate a garment from this seed with 10 % gain spread, 3 % hysteresis and 2 % noise, and a user who
    /// loads it
    #[arg(long, value_name = "SEED", conflicts_with = "source")]
    pub simulate: Option<u64>,
}

/// [`Over`] on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Cover {
    /// all taxels of a panel
    Panel,
    /// all taxels of a block
    Block,
    /// a taxel alone
    Taxel,
}

impl From<Cover> for Over {
    fn from(cover: Cover) -> Over {
        match cover {
            Cover::Panel => Over::Panel,
            Cover::Block => Over::Block,
            Cover::Taxel => Over::Taxel,
        }
    }
}

#[derive(Debug, Clone, Subcommand)]
enum Also {
    /// Check whether a calibration still holds, and if not, why
    #[command(
        after_help = "Examples:\n  taxel calibrate check calibration.toml\n  taxel calibrate check calibration.toml --press 20"
    )]
    Check(CalibrationCheckArgs),
    /// Find the shortest settling time of a garment
    #[command(
        after_help = "Examples:\n  taxel calibrate settle --garment garment.toml -o settled.toml\n  taxel calibrate settle --source serial:/dev/ttyACM0 --error 2 --json"
    )]
    Settle(SettleArgs),
}

/// Runs the command.
pub fn run(args: CalibrateArgs) -> Result<()> {
    match &args.also {
        Some(Also::Check(args)) => return check::run(args),
        Some(Also::Settle(args)) => return settle::run(args),
        None => {}
    }
    let weights = weights(&args)?;
    ensure!(args.wait.is_finite() && args.wait > 0.0, Fault::usage("--wait must be a time above 0"));
    let inputs = args.garment.iter().map(PathBuf::from).chain(args.source.file());
    let output = Output::stream(&args.output, args.force, inputs)?;
    let mut board = open(&args, &weights)?;
    if let (Some(garment), None) = (&args.garment, args.simulate) {
        board.use_garment(&taxel::files::garments::load(garment)?)?;
    }
    let task = CalibrationTask {
        over: Over::from(args.over),
        weights,
        by: by(&args),
        wait: args.wait,
        json: args.json,
    };
    let made = calibrate(&mut board, &task)?;
    keep(&made, output)?;
    install(&mut board, &made)?;
    if args.save {
        board.ask(&Request::Save)?;
    }
    board.give_back()?;
    print(&args, &made);
    Ok(())
}

/// Writes the calibration. If the file cannot be written, prints it, so that the weights need not be put on
/// again.
fn keep(made: &Calibration, output: Output) -> Result<()> {
    let text = made.text()?;
    Ok(output.write(text.as_bytes()).inspect_err(|_| println!("{text}"))?)
}

/// The weights in N, validated, ascending.
fn weights(args: &CalibrateArgs) -> Result<Vec<f64>> {
    let unit = if args.kg { GRAVITY } else { 1.0 };
    let mut weights: Vec<f64> = args.weights.iter().map(|weight| weight * unit).collect();
    if weights.is_empty() {
        weights = Over::from(args.over).weights().to_vec();
    }
    if let Some(wrong) = weights.iter().find(|w| !w.is_finite() || **w <= 0.0 || **w > 10_000.0) {
        bail!(Fault::usage(format!("--weights must be above 0 and at most 10000 N, not {wrong}")));
    }
    weights.sort_by(f64::total_cmp);
    weights.dedup();
    Ok(weights)
}

fn open(args: &CalibrateArgs, weights: &[f64]) -> Result<RawBoard> {
    let Some(seed) = args.simulate else { return RawBoard::open(&args.source) };
    let name = args.garment.as_deref().unwrap_or(SIMULATED);
    let garment = taxel::files::garments::load(name)?;
    let layout = Layout::build(&garment, usize::from(u16::MAX), 4095)?;
    let plates = plates(&garment, &layout, Over::from(args.over))?;
    let script = operator::script(name, &layout, &plates, weights, &SENSOR, seed)?;
    RawBoard::on(source::simulated(script, &RawBoard::options())?)
}

fn by(args: &CalibrateArgs) -> String {
    let user = || std::env::var("USER").or_else(|_| std::env::var("USERNAME")).ok();
    args.by.clone().or_else(user).unwrap_or_else(|| "unknown".into())
}

fn print(args: &CalibrateArgs, made: &Calibration) {
    let fit = &made.fit;
    if args.json {
        let file = args.output.display().to_string();
        return println!(
            "{}",
            json!({
                "type": "calibrated", "id": made.id, "date": made.date, "fit": fit, "weights": made.weights,
                "silent": made.silent, "file": file,
            })
        );
    }
    let percent = |part: f64| format!("{:.1} %", 100.0 * part);
    println!("\n  weight     felt coming  going      error rms");
    for OfWeight { newtons, coming, going, error } in &made.weights {
        let going = going.map_or_else(|| "-".into(), |going| format!("{going:.2} N"));
        println!(
            "  {:<10} {:<12} {going:<10} {}",
            format!("{newtons:.2} N"),
            format!("{coming:.2} N"),
            percent(*error)
        );
    }
    println!(
        "\nCalibration {} of {}: forces within {} rms ({} at most); hysteresis {}; noise of a taxel {:.1} counts at rest, {} \
         under the heaviest weight.",
        made.id,
        made.garment,
        percent(fit.error),
        percent(fit.worst),
        percent(fit.hysteresis),
        fit.rest,
        percent(fit.noise)
    );
    if !made.silent.is_empty() {
        println!("{} taxels do not respond: `taxel health` lists them.", made.silent.len());
    }
    let kept =
        if args.save { "has stored its share" } else { "has its share until it restarts (--save keeps it)" };
    println!("The board {kept}; the curves are in {}.", args.output.display());
}
