//! `taxel gestures`: which gesture a touch is, by a model that fits the board.

use crate::arrays;
use crate::touches::{self, Course, Data, Report, Settings, Shipped, Source, Table, Times, Touch};
use anyhow::{Context, Result, bail, ensure};
use clap::{Args, Subcommand, ValueEnum};
use std::path::{Path, PathBuf};
use taxel_core::gesture::{CLASSES, Model};

/// The model that is shipped: trained on the recordings its notes name; `docs/models.md` is its card.
pub const SHIPPED: &[u8] = include_bytes!("../models/gestures.model");

/// Chosen by cross-validation by participant.
pub const SETTINGS: Settings =
    Settings { pressed: 12, part: 216, penalty: 40.0, balance: 0.0, mirrored: false };

/// Times of observation, seconds.
const TIMES: [f64; 7] = [0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Arguments of `taxel gestures`.
#[derive(Debug, Clone, Args)]
pub struct GesturesArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Clone, Subcommand)]
enum Command {
    /// Train a model
    Train {
        #[command(flatten)]
        files: Files,
        /// Where to write the model
        #[arg(short, long, value_name = "MODEL")]
        output: PathBuf,
    },
    /// Evaluate a model, or, with --cross, how well one trained on the others does on each group
    Eval {
        #[command(flatten)]
        files: Files,
        /// The model; without it the shipped one
        #[arg(long, conflicts_with = "cross")]
        model: Option<PathBuf>,
        /// Keep each of these apart in turn
        #[arg(long, value_name = "GROUPS")]
        cross: Option<Cross>,
        /// Frames per second, for the times observed
        #[arg(long, value_name = "HZ", default_value_t = 54.0)]
        rate: f64,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// The card of the shipped models: data, split, figures, where they fail
    Card,
}

/// What to keep apart.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Cross {
    /// Each participant
    Participant,
}

/// Recorded gestures.
#[derive(Debug, Clone, Args)]
pub struct Files {
    /// Frames: all recordings of equal length, one after the other
    #[arg(long, value_name = "F.npz")]
    pub frames: PathBuf,
    /// A line for each recording, with columns gesture and participant
    #[arg(long, value_name = "L.csv")]
    pub labels: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: GesturesArgs) -> Result<()> {
    match args.command {
        Command::Train { files, output } => write(&load(&files)?, &SETTINGS, &output),
        Command::Eval { files, model, cross, rate, json } => {
            let times = times(rate)?;
            let report = match cross {
                Some(Cross::Participant) => touches::cross(&load(&files)?, &SETTINGS, &times)?,
                None => evaluate(&load(&files)?, model.as_deref(), SHIPPED, &times)?,
            };
            print(&report, json);
            Ok(())
        }
        Command::Card => {
            print!("{}", include_str!("../../docs/models.md"));
            Ok(())
        }
    }
}

/// What `eval --cross participant` finds.
pub fn across_people(files: &Files) -> Result<Report> {
    touches::cross(&load(files)?, &SETTINGS, &times(54.0)?)
}

/// Times of observation at so many frames per second.
fn times(rate: f64) -> Result<Times> {
    ensure!(rate > 0.0 && rate.is_finite(), "--rate {rate}: expected a number above 0");
    let frames = |seconds: &f64| ((seconds * rate).round() as usize).max(1);
    Ok(Times { unit: "seconds", steps: TIMES.iter().map(|t| (*t, frames(t))).collect() })
}

/// Trains on all touches and writes the model.
pub fn write(data: &Data, settings: &Settings, output: &Path) -> Result<()> {
    eprintln!("{} touches of {} classes", data.touches.len(), data.classes.len());
    let mut courses = Vec::new();
    for (number, touch) in data.touches.iter().enumerate() {
        courses.push((Course::of(data, touch, settings), touch.class));
        if number % 50 == 49 {
            eprintln!("features of {} of {} touches", number + 1, data.touches.len());
        }
    }
    let examples: Vec<_> = courses.iter().map(|(course, class)| (course, *class)).collect();
    let bytes = touches::train(data, &examples, settings)?;
    std::fs::write(output, &bytes).with_context(|| format!("{}: cannot be written", output.display()))?;
    eprintln!("{}: {} bytes", output.display(), bytes.len());
    Ok(())
}

/// Applies the model of a file, else the shipped one, as it is.
pub fn evaluate(data: &Data, model: Option<&Path>, shipped: &[u8], times: &Times) -> Result<Report> {
    let bytes = match model {
        Some(path) => touches::read(path)?,
        None => shipped.to_vec(),
    };
    let model = Model::read(&bytes)?;
    let trained_on = Shipped::of(&model)?.knows(&data.sources);
    let mut report = touches::as_it_is(&model, data, times)?;
    if trained_on {
        eprintln!(
            "warning: the model was trained on this file; how well it does on others is what --cross tells"
        );
    }
    report.add("trained_on", trained_on.into());
    report.add("model_bytes", bytes.len().into());
    Ok(report)
}

/// Prints a report.
pub fn print(report: &Report, json: bool) {
    if json {
        println!("{}", report.json());
    } else {
        print!("{}", report.text());
    }
}

/// Reads recorded gestures.
fn load(files: &Files) -> Result<Data> {
    let path = &files.frames;
    let Some(labels) = &files.labels else {
        bail!("{}: frames of gestures hold no labels, name their file with --labels", path.display());
    };
    let frames = arrays::read(path, None)?;
    let table = Table::read(labels)?;
    let columns = || Ok::<_, anyhow::Error>((table.column("gesture")?, table.column("participant")?));
    let (gestures, people) = columns().with_context(|| labels.display().to_string())?;
    ensure!(!table.is_empty(), "{}: there are no labels", labels.display());
    ensure!(
        frames.count % table.len() == 0,
        "{}: {} frames are not as many for each of the {} recordings that {} lists",
        path.display(),
        frames.count,
        table.len(),
        labels.display()
    );
    let mut classes: Vec<String> = gestures.iter().map(|gesture| gesture.to_string()).collect();
    classes.sort();
    classes.dedup();
    ensure!(classes.len() <= CLASSES, "{}: {} gestures, at most {CLASSES}", labels.display(), classes.len());
    let touches =
        frames.values.chunks_exact(frames.values.len() / table.len()).zip(gestures.iter().zip(people));
    let touches = touches.map(|(values, (gesture, group))| Touch {
        values: values.to_vec(),
        class: classes.iter().position(|class| class == gesture).unwrap_or_default(),
        label: gesture.to_string(),
        group: group.to_string(),
    });
    let touches = touches.collect();
    let sources = vec![Source::of(path)?, Source::of(labels)?];
    Ok(Data { rows: frames.rows, columns: frames.columns, classes, touches, idle: Vec::new(), sources })
}
