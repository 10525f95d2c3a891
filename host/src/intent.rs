//! `taxel intent`: recognises the intention of a touch by a model that fits the board.

use crate::arrays;
use crate::doubts::start_ups;
use crate::touches::{
    self, Data, EvalArgs, Files, Report, Settings, Source, Table, Task, Times, Touch, TrainArgs, Windows,
    grid, labels,
};
use anyhow::{Context, Result, bail, ensure};
use clap::{Args, Subcommand, ValueEnum};
use taxel_core::gesture::Shipped;

/// Chosen by cross-validation by day.
const SETTINGS: Settings = Settings {
    pressed: 200,
    halves: true,
    penalty: 10.0,
    balance: 1.0,
    mirrored: true,
    early: [Some(Windows { shortest: 3, longest: 11, every: 0 }), None],
    concludes: true,
};

const TASK: Task = Task {
    shipped: Shipped::Intent,
    settings: SETTINGS,
    candidates: || grid(SETTINGS, &[3.0, 10.0, 30.0, 100.0], &[0.0, 0.5, 1.0]),
};

/// Observation times, frames.
const FRAMES: [u16; 12] = [1, 2, 3, 4, 5, 6, 8, 10, 15, 20, 40, 80];

/// Gestures of each intention.
const MEANINGS: [(&str, &[&str]); 3] = [
    ("kindness", &["stroke", "hug", "tap", "tickle"]),
    ("threat", &["grab", "squeez", "squeeze"]),
    ("attack", &["punch"]),
];

/// Arguments of `taxel intent`.
#[derive(Debug, Clone, Args)]
pub struct IntentArgs {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Clone, Subcommand)]
enum Command {
    /// Train a model
    Train(TrainArgs),
    /// Evaluate a model; with --cross, train on all groups but one and test on that one, in turn
    Eval(EvalArgs<Cross>),
    /// Print the card of the shipped models: data, split, figures, where they fail
    Card,
}

/// Groups that are left out in turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Cross {
    /// Each recording
    Recording,
    /// The recordings of each day, which is in their names
    Day,
}

/// Runs the command.
pub fn run(args: IntentArgs) -> Result<()> {
    match args.command {
        Command::Train(args) => {
            let output = args.output()?;
            TASK.train(&load(&args.files, Cross::Day)?, output)
        }
        Command::Eval(args) => {
            let data = load(&args.files, args.cross.unwrap_or(Cross::Day))?;
            TASK.eval(&args, data, &times())
        }
        Command::Card => {
            print!("{}", touches::CARDS);
            Ok(())
        }
    }
}

/// Report of `eval --cross day`.
pub fn across_days(files: &Files) -> Result<Report> {
    touches::cross(&load(files, Cross::Day)?, &SETTINGS, &times())
}

fn times() -> Times {
    let steps = FRAMES.iter().map(|frames| (f64::from(*frames), usize::from(*frames))).collect();
    Times { unit: "frames", frame: 1.0, steps, every: 1 }
}

/// Reads recorded touches: each run of frames with one label is a touch.
fn load(files: &Files, apart: Cross) -> Result<Data> {
    let (path, labels) = (&files.frames, labels(files)?);
    let frames = arrays::read(path, None)?;
    let table = Table::read(labels)?;
    let columns = || Ok::<_, anyhow::Error>((table.column("recording")?, table.column("label")?));
    let (recordings, names) = columns().with_context(|| labels.display().to_string())?;
    let (count, lines) = (frames.count, table.len());
    ensure!(count == lines, "{}: {lines} labels for {count} frames", labels.display());
    let lines: Vec<(&str, &str)> = recordings.into_iter().zip(names).collect();
    let area = usize::from(frames.rows) * usize::from(frames.columns);
    let (mut touches, mut idle, mut start) = (Vec::new(), Vec::new(), 0);
    for stretch in lines.chunk_by(|a, b| a == b) {
        let (recording, label) = stretch[0];
        let values = frames.values[start * area..(start + stretch.len()) * area].to_vec();
        start += stretch.len();
        let group = if apart == Cross::Day { day(recording) } else { recording };
        let class = meaning(label);
        let touch = Touch { values, class: class.unwrap_or(0), label: label.into(), group: group.into() };
        match class {
            Some(_) => touches.push(touch),
            None if label.eq_ignore_ascii_case("none") => idle.push(touch),
            None => bail!("{}: the label {label} has no meaning here", labels.display()),
        }
    }
    ensure!(!touches.is_empty(), "{}: there are no touches", labels.display());
    let mut rest = frames.values.chunks_exact(area);
    let recordings = lines.chunk_by(|a, b| a.0 == b.0);
    let named = recordings.map(|lines| {
        let own: Vec<&[u16]> = rest.by_ref().take(lines.len()).collect();
        (lines[0].0.to_string(), own.into_iter())
    });
    let doubts = start_ups(named).into_iter().collect();
    let classes = MEANINGS.iter().map(|(name, _)| name.to_string()).collect();
    let sources = vec![Source::of(path)?, Source::of(labels)?];
    Ok(Data { rows: frames.rows, columns: frames.columns, classes, touches, idle, doubts, sources })
}

fn meaning(label: &str) -> Option<usize> {
    let label = label.to_lowercase();
    MEANINGS.iter().position(|(_, gestures)| gestures.contains(&label.as_str()))
}

/// The day's eight digits in a name such as Tap_20250527135406; the whole name if there are none.
fn day(recording: &str) -> &str {
    let digits = |part: &&str| part.len() >= 8 && part.bytes().all(|byte| byte.is_ascii_digit());
    recording.split('_').find(digits).map_or(recording, |part| &part[..8])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_their_day_and_labels_their_meaning() {
        assert_eq!((day("Tap_20250527135406"), day("mine"), day("a_2025")), ("20250527", "mine", "a_2025"));
        assert_eq!((meaning("Squeez"), meaning("Punch"), meaning("None")), (Some(1), Some(2), None));
    }
}
