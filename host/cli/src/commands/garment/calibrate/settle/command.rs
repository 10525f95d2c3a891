//! The command `taxel calibrate settle`.

use super::search::{Scanner, Settled, settle};
use crate::commands::garment;
use crate::fault::Fault;
use crate::watch::Overwrite;
use crate::watch::raw::RawBoard;
use anyhow::{Result, bail};
use clap::Args;
use serde_json::json;
use std::collections::BTreeSet;
use std::path::PathBuf;
use taxel::files::output::Output;
use taxel::sim::FULL_SCALE;
use taxel::source::SourceSpec;
use taxel_core::acquire::{Plan, Rounds, frame_us};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::wire::Request;

/// Frames after a change of the settling time that may still have the old one.
const OLD: u32 = 2;

/// Arguments of `taxel calibrate settle`.
#[derive(Debug, Clone, Args)]
pub struct SettleArgs {
    /// The board: `auto`, `usb[:SERIAL]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD`, `sim[:TOUCHES]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// The garment, a preset or a TOML file [default: the board's]
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// Largest residue of a full-scale step between two taxels, counts of 4,095
    #[arg(long, value_name = "COUNTS", default_value_t = 4.0, allow_negative_numbers = true)]
    pub error: f64,
    /// File to write [default: print the garment]
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Also save the garment to the board's flash
    #[arg(long)]
    pub save: bool,
    /// Print JSON instead of sentences
    #[arg(long)]
    pub json: bool,
}

/// A board whose garment is sent again with each settling time.
struct SettledBoard<'a> {
    board: &'a mut RawBoard,
    garment: Garment,
}

impl Scanner for SettledBoard<'_> {
    fn scan(&mut self, settle_ns: u32, frames: u32) -> Result<Vec<f64>> {
        self.garment.wiring.settle_ns = settle_ns;
        self.board.use_garment(&self.garment)?;
        for _ in 0..OLD {
            self.board.frame()?;
        }
        let mut sums = Vec::new();
        for _ in 0..frames {
            let frame = self.board.frame()?;
            sums.resize(frame.codes.len(), 0.0);
            sums.iter_mut().zip(&frame.codes).for_each(|(sum, code)| *sum += f64::from(*code));
        }
        sums.iter_mut().for_each(|sum| *sum /= f64::from(frames));
        Ok(sums)
    }
}

/// Runs the command.
pub fn run(args: &SettleArgs) -> Result<()> {
    if !args.error.is_finite() || !(0.5..=400.0).contains(&args.error) {
        bail!(Fault::usage("--error must be 0.5 to 400 counts"));
    }
    let inputs = args.garment.iter().map(PathBuf::from).chain(args.source.file());
    let output = args.output.as_ref().map(|name| Output::stream(name, args.force, inputs)).transpose()?;
    let given = args.garment.as_deref().map(taxel::files::garments::load).transpose()?;
    let mut board = RawBoard::open(&args.source)?;
    let mut garment = given.unwrap_or_else(|| board.garment().clone());
    if !args.json {
        println!(
            "{}: lay something with edges on the garment, on each panel at best, and leave it there.",
            board.label()
        );
    }
    let settled =
        settle(&mut SettledBoard { board: &mut board, garment: garment.clone() }, &garment, args.error)?;
    let before_ns = garment.wiring.settle_ns;
    garment.wiring.settle_ns = settled.settle_ns;
    board.leave(&garment)?;
    if args.save {
        board.ask(&Request::Save)?;
    }
    print(args, before_ns, &settled, &garment)?;
    if args.json && output.is_none() {
        return Ok(());
    }
    let comment = format!(
        "Settling found by taxel calibrate settle: {:.1} counts are left of a full-scale step.",
        settled.residue_counts
    );
    garment::write(&garment, &comment, output)
}

/// Prints the result; `garment` has the settling time that was found.
fn print(args: &SettleArgs, before_ns: u32, settled: &Settled, garment: &Garment) -> Result<()> {
    let layout = Layout::build(garment, usize::from(u16::MAX), FULL_SCALE)?;
    let circuit = Circuit::build(garment, &layout, Pins::ANY)?;
    let inputs: BTreeSet<u8> = circuit.sites().iter().map(|site| site.input).collect();
    let given_ns = Rounds::of(inputs.len(), settled.settle_ns).settling_ns();
    if args.json {
        let line = json!({
            "type": "settled", "settle_ns": settled.settle_ns, "before_ns": before_ns, "in_slots_ns": given_ns,
            "residue_counts": settled.residue_counts, "error_counts": settled.error_counts, "slow_ns": settled.slow_ns,
            "measured": settled.measured, "unmeasured": settled.unmeasured,
        });
        println!("{line}");
        return Ok(());
    }
    println!(
        "Settling: {} ns (before: {before_ns}). It leaves {:.1} +- {:.1} counts of a full-scale step.",
        settled.settle_ns, settled.residue_counts, settled.error_counts
    );
    println!(
        "A board that scans by DMA settles for whole conversions: {given_ns} ns, at {:.1} frames/s.",
        1e6 / frame_us(&circuit, &Plan::default()) as f64
    );
    if !settled.unmeasured.is_empty() {
        let pins: Vec<_> = settled.unmeasured.iter().map(|pin| format!("GP{pin}")).collect();
        println!("Not measured, because nothing with an edge lay there: {}.", pins.join(", "));
    }
    Ok(())
}
