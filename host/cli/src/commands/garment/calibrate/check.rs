//! The command `taxel calibrate check`.

use super::dialogue::Dialogue;
use crate::fault::{Blame, Fault};
use crate::watch::raw::RawBoard;
use crate::watch::time;
use anyhow::{Context, Result, ensure};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::time::Duration;
use taxel::files::calibrate::{Calibration, Over, Plate, Reading, Reason, Seen, judge, plates};
use taxel::source::SourceSpec;
use taxel::text::date;
use taxel_core::condition::UNITY;
use taxel_core::garment::Layout;

/// Arguments of `taxel calibrate check`.
#[derive(Debug, Clone, Args)]
pub struct CalibrationCheckArgs {
    /// Calibration file
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// The board: `auto`, `usb[:SERIAL]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD`, `sim[:TOUCHES]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// Also ask for a known weight on a plate that covers the first panel, N
    #[arg(long, value_name = "N")]
    pub press: Option<f64>,
    /// Repeat after this time, such as 10min, until Ctrl-C and report changes
    #[arg(long, value_name = "TIME", value_parser = time, conflicts_with = "press")]
    pub every: Option<f64>,
    /// Days after which a calibration is old
    #[arg(long, value_name = "DAYS", default_value_t = 180)]
    pub days: u64,
    /// Longest wait for the weight
    #[arg(long, value_name = "TIME", default_value = "2min", value_parser = time)]
    pub wait: f64,
    /// Print JSON instead of sentences
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: &CalibrationCheckArgs) -> Result<()> {
    let above = |value: Option<f64>| value.is_none_or(|value| value.is_finite() && value > 0.0);
    ensure!(above(args.press), Fault::usage("--press must be a force above 0"));
    ensure!(above(args.every), Fault::usage("--every must be a time above 0"));
    let calibration = Calibration::read(&args.file)?;
    let Some(every) = args.every else {
        let reasons = reasons(args, &calibration)?;
        print(args, &calibration, &reasons);
        ensure!(reasons.is_empty(), "calibration {} does not hold", calibration.id);
        return Ok(());
    };
    let pause = Duration::try_from_secs_f64(every).context("--every").usage()?;
    let mut reported = None;
    loop {
        let now = reasons(args, &calibration)?;
        // The numbers in a reason change all the time; only a change of the kinds of reasons is reported.
        let kinds: Vec<_> = now.iter().map(std::mem::discriminant).collect();
        if reported.as_ref() != Some(&kinds) {
            print(args, &calibration, &now);
            reported = Some(kinds);
        }
        std::thread::sleep(pause);
    }
}

/// Checks the garment once.
fn reasons(args: &CalibrationCheckArgs, calibration: &Calibration) -> Result<Vec<Reason>> {
    let mut board = RawBoard::open(&args.source)?;
    let description = board.description().context("the board has not sent its garment").board()?;
    let (garment, reported) = (description.garment.clone(), description.calibration.clone());
    let layout = Layout::build(&garment, usize::from(u16::MAX), 4095)?;
    let mut dialogue = Dialogue::new(&mut board, garment.wiring.falling, args.wait, args.json);
    if args.every.is_none() {
        dialogue.ask_for_rest();
    }
    let rest = dialogue.rest()?;
    let mut press = None;
    if let (Some(newtons), true) = (args.press, rest.codes.len() == calibration.gains.len()) {
        let mut plates = plates(&garment, &layout, Over::Panel)?;
        plates.truncate(1);
        let readings = dialogue.readings(&plates, &[newtons], &rest)?;
        let reading = readings.first().context("nothing was felt")?;
        press = Some((newtons, felt(calibration, &plates[0], reading)?));
    }
    let celsius = board.celsius();
    let faulty = board.faulty().keys().copied().collect();
    board.give_back()?;
    let seen =
        Seen { reported, rest: rest.codes, faulty, today: date::today(), days: args.days, press, celsius };
    Ok(judge(calibration, &seen))
}

fn print(args: &CalibrationCheckArgs, calibration: &Calibration, reasons: &[Reason]) {
    if args.json {
        let why: Vec<String> = reasons.iter().map(ToString::to_string).collect();
        let line = json!({ "type": "check", "id": calibration.id, "holds": why.is_empty(), "why": why });
        return println!("{line}");
    }
    match reasons.is_empty() {
        true => println!("Calibration {} of {} holds.", calibration.id, calibration.date),
        false => println!("Calibrate again (`taxel calibrate`), because"),
    }
    reasons.iter().for_each(|reason| println!("  {reason}."));
}

/// Force of a known weight by the calibration, N.
fn felt(calibration: &Calibration, plate: &Plate, reading: &Reading) -> Result<f64> {
    let name = plate.name.trim_start_matches("panel ");
    let panel = calibration.panels.iter().find(|panel| panel.name == name);
    let curve = &panel.with_context(|| format!("the calibration has no panel {name}"))?.knots;
    let force = |(taxel, counts): (&u16, &f64)| {
        let gain = f64::from(calibration.gains[usize::from(*taxel)]) / f64::from(UNITY);
        curve
            .micronewtons((counts.max(0.0) * gain * f64::from(taxel::files::calibrate::PARTS)).round() as u32)
            as f64
            / 1e6
    };
    let live =
        plate.taxels.iter().zip(&reading.counts).filter(|(taxel, _)| !calibration.silent.contains(taxel));
    let forces: Vec<f64> = live.map(force).collect();
    Ok(forces.iter().sum::<f64>() * plate.taxels.len() as f64 / forces.len().max(1) as f64)
}
