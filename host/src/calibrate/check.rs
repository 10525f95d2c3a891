//! The command `taxel calibrate check`.

use super::dialogue::Dialogue;
use super::drift::{Seen, judge};
use super::file::Calibration;
use super::plates::{Over, Plate, plates};
use super::reading::Reading;
use crate::date;
use crate::raw::RawBoard;
use crate::source::SourceSpec;
use anyhow::{Context, Result, ensure};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use taxel_core::condition::UNITY;
use taxel_core::garment::Layout;

/// What `taxel calibrate check` takes.
#[derive(Debug, Clone, Args)]
pub struct CheckArgs {
    /// The calibration
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The board: `auto`, `usb`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `sim[:SCENE]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// A known weight to be put on a plate that covers the first panel, N
    #[arg(long, value_name = "N")]
    pub press: Option<f64>,
    /// Days after which a calibration is old
    #[arg(long, value_name = "DAYS", default_value_t = 180)]
    pub days: u64,
    /// Seconds of the board to wait for the weight
    #[arg(long, value_name = "S", default_value_t = 120.0)]
    pub wait: f64,
    /// Print JSON instead of sentences
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: &CheckArgs) -> Result<()> {
    ensure!(
        args.press.is_none_or(|press| press.is_finite() && press > 0.0),
        "--press must be a force above 0"
    );
    let calibration = Calibration::read(&args.file)?;
    let mut board = RawBoard::open(&args.source)?;
    let worn = board.worn().context("the board has not said what it wears")?;
    let (garment, told) = (worn.garment.clone(), worn.calibration.clone());
    let layout = Layout::build(&garment, usize::from(u16::MAX), 4095)?;
    let (falling, wait, json) = (garment.wiring.falling, args.wait, args.json);
    let mut dialogue = Dialogue { board: &mut board, falling, wait, json };
    let rest = dialogue.rest()?;
    let mut press = None;
    if let (Some(newtons), true) = (args.press, rest.len() == calibration.gains.len()) {
        let mut plates = plates(&garment, &layout, Over::Panel)?;
        plates.truncate(1);
        let readings = dialogue.readings(&plates, &[newtons], &rest)?;
        press = Some((newtons, felt(&calibration, &plates[0], &readings[0])?));
    }
    let ill = board.ill().keys().copied().collect();
    board.give_back()?;
    let seen = Seen { told, rest, ill, today: date::today(), days: args.days, press };
    let reasons: Vec<String> = judge(&calibration, &seen).iter().map(ToString::to_string).collect();
    if args.json {
        println!(
            "{}",
            json!({ "type": "check", "id": calibration.id, "holds": reasons.is_empty(), "why": reasons })
        );
        return Ok(());
    }
    match reasons.is_empty() {
        true => println!("Calibration {} of {} holds.", calibration.id, calibration.date),
        false => println!("Calibrate again (`taxel calibrate`), because"),
    }
    reasons.iter().for_each(|reason| println!("  {reason}."));
    Ok(())
}

/// A known force by the calibration, N.
fn felt(calibration: &Calibration, plate: &Plate, reading: &Reading) -> Result<f64> {
    let name = plate.name.trim_start_matches("panel ");
    let panel = calibration.panels.iter().find(|panel| panel.name == name);
    let curve = &panel.with_context(|| format!("the calibration knows no panel {name}"))?.knots;
    let force = |(taxel, counts): (&u16, &f64)| {
        let gain = f64::from(calibration.gains[usize::from(*taxel)]) / f64::from(UNITY);
        curve.micronewtons((counts.max(0.0) * gain * f64::from(super::curve::PARTS)).round() as u32) as f64
            / 1e6
    };
    let live =
        plate.taxels.iter().zip(&reading.counts).filter(|(taxel, _)| !calibration.silent.contains(taxel));
    let forces: Vec<f64> = live.map(force).collect();
    Ok(forces.iter().sum::<f64>() * plate.taxels.len() as f64 / forces.len().max(1) as f64)
}
