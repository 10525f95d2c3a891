//! Recorded intentions, and the settings with which their model is trained.

use super::{Data, Files, Report, Table, Times, Touch, TouchesFile, TrainSettings, Windows, cross, labels};
use anyhow::{Context, Error, Result, bail, ensure};
use taxel::files::arrays;
use taxel::learn::doubts::start_ups;

/// Chosen by cross-validation by day.
pub const SETTINGS: TrainSettings = TrainSettings {
    pressed: 200,
    halves: true,
    penalty: 10.0,
    balance: 1.0,
    mirrored: true,
    early: [Some(Windows { shortest: 3, longest: 11, every: 0 }), None],
    concludes: true,
};

/// Observation times, frames.
const FRAMES: [u16; 12] = [1, 2, 3, 4, 5, 6, 8, 10, 15, 20, 40, 80];

/// Gestures of each intention.
const MEANINGS: [(&str, &[&str]); 3] = [
    ("kindness", &["stroke", "hug", "tap", "tickle"]),
    ("threat", &["grab", "squeez", "squeeze"]),
    ("attack", &["punch"]),
];

/// Groups of touches, which are left out together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Apart {
    /// Each recording.
    Recording,
    /// The recordings of each day, which is in their names.
    Day,
}

/// Report of `eval --cross day`.
pub fn across_days(files: &Files) -> Result<Report> {
    cross(&load(files, Apart::Day)?, &SETTINGS, &times())
}

/// Observation times.
pub fn times() -> Times {
    let steps = FRAMES.iter().map(|frames| (f64::from(*frames), usize::from(*frames))).collect();
    Times { unit: "frames", frame: 1.0, steps, every: 1 }
}

/// Reads recorded touches: each run of frames with one label is a touch.
pub fn load(files: &Files, apart: Apart) -> Result<Data> {
    let (path, labels) = (&files.frames, labels(files)?);
    let frames = arrays::read(path, None)?;
    let table = Table::read(labels)?;
    let columns = || Ok::<_, Error>((table.column("recording")?, table.column("label")?));
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
        let group = if apart == Apart::Day { day(recording) } else { recording };
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
    let sources = vec![TouchesFile::of(path)?, TouchesFile::of(labels)?];
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
