//! `taxel process`: runs the board's pipeline over recorded frames, one JSON object per frame.

use crate::fault::Fault;
use anyhow::{Context, Result, bail};
use clap::Args;
use serde_json::{Value, json};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use taxel::files::arrays::{self, Frames};
use taxel::json::Replay;
use taxel::learn::doubts;
use taxel::robot::FormsInFrame;
use taxel::text::progress::{Progress, Unit};
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel process subject_01.npz --array posture_03 --rate 1 --json
  taxel process frames.npy --full-scale 1000 --tare 16";

/// Run recorded frames through the board's perception
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ProcessArgs {
    /// Recorded frames: .npy, .npz ([n, rows, columns] or [rows, columns]) or .csv
    pub file: PathBuf,
    /// Array of an .npz [default: all that hold frames, one after the other]
    #[arg(long, value_name = "NAME")]
    pub array: Option<String>,
    /// Garment whose taxels the frames hold: a preset or a TOML file [default: one panel of the array's size]
    #[arg(long, value_name = "L")]
    pub layout: Option<String>,
    /// Frames per second: frame k is taken at k / rate
    #[arg(long, value_name = "HZ", default_value_t = 195.0)]
    pub rate: f64,
    /// Largest value of a taxel; the limits of the shipped scene are scaled to it
    #[arg(long, value_name = "N", default_value_t = 4095)]
    pub full_scale: u16,
    /// Take the mean of the first N frames as the baseline
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub tare: u16,
    /// Number of contacts per frame, in turn, whose form (outline, azimuth, breadth, shape) is computed: 1 to
    /// 254, or all; on a board 1
    #[arg(long, value_name = "N", default_value = "all")]
    pub forms: FormsInFrame,
    /// Print JSON, one object per frame
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: ProcessArgs) -> Result<()> {
    if !(args.rate.is_finite() && args.rate > 0.0 && args.rate <= 1e6) {
        bail!(Fault::usage(format!("--rate {}: it must be above 0 and at most 1000000 Hz", args.rate)));
    }
    if args.full_scale == 0 {
        bail!(Fault::usage("--full-scale 0: it must be 1 to 65535"));
    }
    let mut out = BufWriter::new(std::io::stdout().lock());
    let recordings = recordings(&args.file, args.array.as_deref())?;
    let several = recordings.len() > 1 || args.array.is_some();
    for (name, frames) in &recordings {
        process(&args, if several { name } else { "" }, frames, &mut out)?;
    }
    Ok(out.flush()?)
}

/// Reads the selected arrays, with their names.
pub fn recordings(file: &Path, array: Option<&str>) -> Result<Vec<(String, Frames)>> {
    match array {
        Some(name) => Ok(vec![(name.to_string(), arrays::read(file, array)?)]),
        None => Ok(arrays::read_all(file)?),
    }
}

fn process(args: &ProcessArgs, name: &str, frames: &Frames, out: &mut impl Write) -> Result<()> {
    let top = frames.values.iter().copied().max().unwrap_or(0).max(args.full_scale);
    let garment = match &args.layout {
        Some(layout) => taxel::files::garments::load(layout)?,
        None => Garment::recorded(frames.rows, frames.columns),
    };
    let place = || format!("{}{}", args.file.display(), array_of(name));
    let mut scene = Scene::scaled(args.full_scale);
    scene.contact.forms_in_frame = args.forms.0;
    let mut replay = Replay::new(&garment, &scene, top).with_context(place)?;
    let taxels = usize::from(frames.rows) * usize::from(frames.columns);
    if taxels != replay.layout.taxels() {
        bail!(
            "{}: frames of {} x {} do not hold the {} taxels of the layout {}",
            place(),
            frames.rows,
            frames.columns,
            replay.layout.taxels(),
            garment.name
        );
    }
    if args.tare > 0 {
        replay.state.condition.tare(args.tare);
    }
    doubt(&place(), frames, args.full_scale);
    let mut progress = Progress::of(place(), Unit::Frames, Some(frames.count as u64));
    for (number, frame) in frames.iter().enumerate() {
        let time = Micros((number as f64 * 1e6 / args.rate).round() as u64);
        let mut object = replay.frame(frame, time);
        object["frame"] = json!(number);
        if !name.is_empty() {
            object["array"] = json!(name);
        }
        if args.json {
            writeln!(out, "{object}")?;
        } else {
            writeln!(out, "{}", line(&object))?;
        }
        progress.at(number as u64 + 1);
    }
    progress.clear();
    eprintln!("{}: {} frames", place(), frames.count);
    Ok(())
}

/// Prints warnings about a recording.
fn doubt(place: &str, frames: &Frames, full_scale: u16) {
    let greatest = frames.values.iter().copied().max().unwrap_or(0);
    let start_up = doubts::start_ups([(place.to_string(), frames.iter())].into_iter());
    let scale = doubts::full_scale(greatest, full_scale).map(|why| format!("{place}: {why}"));
    let top = doubts::top(frames.values.iter().copied());
    let top =
        top.map(|top| format!("{place}: saturation: values stop at {top}; greater forces look the same"));
    [start_up, scale, top].into_iter().flatten().for_each(|doubt| eprintln!("warning: {doubt}"));
}

fn array_of(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!(", array {name}") }
}

/// Formats a frame as a line of text.
fn line(object: &Value) -> String {
    let contacts = object["contacts"].as_array().map_or(&[][..], Vec::as_slice);
    let each = contacts.iter().map(|c| {
        let (x, y) = (c["column"].as_f64().unwrap_or(0.0), c["row"].as_f64().unwrap_or(0.0));
        format!(
            "#{} {} total {} peak {} area {} at ({x:.2}, {y:.2})",
            c["id"],
            c["shape"].as_str().unwrap_or("?"),
            c["total"],
            c["peak"],
            c["area"]
        )
    });
    let leading = object["intent"]["leading"].as_str().unwrap_or("none");
    let all = each.collect::<Vec<_>>().join("; ");
    format!("frame {}: {leading}; {}", object["frame"], if all.is_empty() { "nothing touches" } else { &all })
}
