//! Pressure of the garment's folds, learned from recordings.

use crate::watch::Overwrite;
use anyhow::{Context, Result};
use clap::Args;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use taxel::client::{Event, ImageNews};
use taxel::files::garments;
use taxel::files::output::Output;
use taxel::learn::folds::{FoldSettings, FoldSweep, LearnedFold, learn};
use taxel::record::{Angles, Play};
use taxel::recording::BoardRecording;
use taxel_core::capacity::TAXELS;
use taxel_core::garment::Layout;

/// Sweeps, and how to learn from them.
#[derive(Debug, Clone, Args)]
pub struct BodyLearnArgs {
    /// Recordings (.mcap, of a robot .mcap#BOARD) with the joints' angles, in which nothing touches the garment:
    /// each of another day, or after it was put on anew
    #[arg(required = true, value_name = "RECORDING")]
    recordings: Vec<BoardRecording>,
    /// The garment: a TOML file or a preset
    #[arg(long, value_name = "G", default_value = "reference")]
    garment: String,
    /// A joint that folds the garment, or a pair of them; may be given several times [default: each joint]
    #[arg(long = "fold", value_name = "JOINT[+JOINT]")]
    folds: Vec<String>,
    /// Angle between the knots of a joint, degrees; wider if the board has not enough room
    #[arg(long, value_name = "DEG", default_value_t = 8.0, value_parser = angle)]
    step: f32,
    /// Most by which the garment shifts from day to day, mm
    #[arg(long, value_name = "MM", default_value_t = 30.0, value_parser = length)]
    shift: f32,
    /// Most by which the angle differs from day to day at which a fold appears, degrees
    #[arg(long, value_name = "DEG", default_value_t = 16.0, value_parser = angle)]
    shift_angle: f32,
    /// The table to write, for `taxel live --folds`
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    force: Overwrite,
}

fn angle(text: &str) -> Result<f32, String> {
    let degrees = text.parse().ok().filter(|degrees| (0.5..=90.0).contains(degrees));
    degrees.ok_or_else(|| "must be 0.5 to 90 degrees".into())
}

fn length(text: &str) -> Result<f32, String> {
    text.parse().ok().filter(|mm| (0.0..=100.0).contains(mm)).ok_or_else(|| "must be 0 to 100 mm".into())
}

/// Learns, and says what.
pub fn run(args: &BodyLearnArgs) -> Result<()> {
    let inputs =
        args.recordings.iter().map(|recording| recording.path.as_path()).chain([Path::new(&args.garment)]);
    let output = Output::file(&args.output, args.force, inputs)?;
    let garment = garments::read(&args.garment)?;
    let layout = Layout::build(&garment.garment, TAXELS, u16::MAX).map_err(|e| garment.error(&e))?;
    let sweeps = args
        .recordings
        .iter()
        .map(|recording| sweep(recording, layout.taxels()))
        .collect::<Result<Vec<_>>>()?;
    let folds = args.folds.iter().map(|fold| fold.split('+').map(String::from).collect()).collect();
    let settings =
        FoldSettings { folds, step_deg: args.step, shift_mm: args.shift, shift_deg: args.shift_angle };
    let learned = learn(&layout, &sweeps, &settings)?;
    output.write(&learned.table)?;
    print!("{}", text(&learned.folds));
    println!("{}: {} bytes, from {}", args.output.display(), learned.table.len(), counted(&sweeps));
    Ok(())
}

/// Reads what the taxels felt in a recording, with the angles that the board knew then.
fn sweep(recording: &BoardRecording, taxels: usize) -> Result<FoldSweep> {
    recording.overview()?;
    let angles = Angles::read(recording)?;
    let joints = angles.joints();
    let mut sweep = FoldSweep::new(joints.to_vec(), taxels);
    let mut now: BTreeMap<&str, f32> = BTreeMap::new();
    let mut angles_left = angles.all().peekable();
    let mut play = Play::open(recording)?;
    while let Some((_, event)) = play.next_event()? {
        let Event::Frame { time, image: ImageNews::Whole, .. } = event else { continue };
        while let Some((_, joint, degrees)) = angles_left.next_if(|(at_us, ..)| *at_us <= time.0) {
            now.insert(joint, degrees);
        }
        // Until every joint was sent, nobody knows the posture.
        let all: Option<Vec<f32>> = joints.iter().map(|joint| now.get(joint.as_str()).copied()).collect();
        if let (Some(degrees), Some((_, image))) = (all, play.client().image()) {
            sweep.push(&degrees, image).with_context(|| recording.to_string())?;
        }
    }
    Ok(sweep)
}

/// A table of the folds.
fn text(folds: &[LearnedFold]) -> String {
    let mut text = format!(
        "{:<34}{:>8}{:>8}{:>7}{:>9}{:>9}{:>11}{:>11}{:>8}{:>7}\n",
        "fold", "taxels", "beside", "knots", "step", "play", "strongest", "explained", "flash", "RAM"
    );
    let degrees = |all: &[f32]| all.iter().map(|one| format!("{one:.1}")).collect::<Vec<_>>().join("+");
    for fold in folds {
        let [pressed, beside] = fold.taxels;
        let [flash, ram] = fold.bytes;
        text += &format!(
            "{:<34}{pressed:>8}{beside:>8}{:>7}{:>9}{:>9}{:>11.0}{:>11.3}{flash:>8}{ram:>7}\n",
            fold.joints.join("+"),
            fold.knots,
            degrees(&fold.step_deg),
            degrees(&fold.play_deg),
            fold.strongest,
            fold.explained,
        );
    }
    text
}

fn counted(sweeps: &[FoldSweep]) -> String {
    let frames: usize = sweeps.iter().map(FoldSweep::frames).sum();
    format!("{frames} frames of {} {}", sweeps.len(), if sweeps.len() == 1 { "sweep" } else { "sweeps" })
}
