//! Recorded gestures, and the settings with which their model is trained.

use super::{Data, Files, Report, Table, Times, Touch, TouchesFile, TrainSettings, Windows, cross, labels};
use anyhow::{Context, Error, Result, ensure};
use taxel::files::arrays;
use taxel::learn::doubts::start_ups;
use taxel_core::gesture::CLASSES;

/// Chosen by cross-validation by participant. Recordings are cut from ongoing touches, so windows may begin
/// anywhere.
pub const SETTINGS: TrainSettings = TrainSettings {
    pressed: 12,
    halves: true,
    penalty: 40.0,
    balance: 0.0,
    mirrored: false,
    early: [
        Some(Windows { shortest: 5, longest: 28, every: 54 }),
        Some(Windows { shortest: 28, longest: 80, every: 54 }),
    ],
    concludes: false,
};

/// Observation times, seconds.
const TIMES: [f64; 7] = [0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Report of `eval --cross participant`.
pub fn across_people(files: &Files) -> Result<Report> {
    cross(&load(files)?, &SETTINGS, &times(54.0)?)
}

/// Observation times at this frame rate.
pub fn times(rate: f64) -> Result<Times> {
    ensure!(rate > 0.0 && rate.is_finite(), "--rate {rate}: expected a number above 0");
    let frames = |seconds: &f64| ((seconds * rate).round() as usize).max(1);
    let steps = TIMES.iter().map(|t| (*t, frames(t))).collect();
    Ok(Times { unit: "seconds", frame: 1.0 / rate, steps, every: frames(&0.1) })
}

/// Reads recorded gestures.
pub fn load(files: &Files) -> Result<Data> {
    let (path, labels) = (&files.frames, labels(files)?);
    let frames = arrays::read(path, None)?;
    let table = Table::read(labels)?;
    let columns = || Ok::<_, Error>((table.column("gesture")?, table.column("participant")?));
    let (gestures, people) = columns().with_context(|| labels.display().to_string())?;
    ensure!(!table.is_empty(), "{}: there are no labels", labels.display());
    ensure!(
        frames.count % table.len() == 0,
        "{}: {} frames cannot be split evenly among the {} recordings that {} lists",
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
    let touches: Vec<Touch> = touches.collect();
    let area = usize::from(frames.rows) * usize::from(frames.columns);
    let named = touches.iter().enumerate();
    let named = named.map(|(n, touch)| (format!("recording {n}"), touch.values.chunks_exact(area)));
    let doubts = start_ups(named).into_iter().collect();
    let sources = vec![TouchesFile::of(path)?, TouchesFile::of(labels)?];
    let (rows, columns, idle) = (frames.rows, frames.columns, Vec::new());
    Ok(Data { rows, columns, classes, touches, idle, doubts, sources })
}
