//! A LeRobot data set (LeRobotDataset v3.0) with one episode per recording.
//!
//! | file | holds |
//! |---|---|
//! | `meta/info.json` | frames per second; type and shape of each feature, for panels also unit, link and pitch |
//! | `meta/stats.json` | minimum, maximum, mean and standard deviation of each feature, element by element |
//! | `meta/tasks.parquet`, `meta/episodes/chunk-000/file-000.parquet` | the task; the place of each episode |
//! | `data/chunk-000/file-000.parquet`, `file-001.parquet`, ... | an episode, one row per frame |
//!
//! | feature | type, shape | what |
//! |---|---|---|
//! | `observation.tactile.PANEL` | f32 \[rows, columns\] | pressure in the panel's unit; in names, all but letters and digits become `_` |
//! | `observation.tactile.intent` | f32 \[concepts\] | activation of each concept of the map, -1 ..= 1, if there is a map |
//! | `timestamp`, `frame_index`, `episode_index`, `index`, `task_index` | f32, i64 | LeRobot's own |
//!
//! LeRobot requires an integer and even frame rate: a row is the last image at its time, by the board's
//! clock; `sampler.rs` describes the handling of leaps of that clock.

mod episode;
mod features;
mod meta;
mod parquet;
mod sampler;
mod stats;

use super::frames::Frames;
use anyhow::{Context, Result};
use episode::Episode;
use features::Features;
use std::num::NonZeroU16;
use std::path::Path;
use taxel::files::output::Folder;

/// Episodes, and so files, per folder.
const CHUNK: usize = 1000;

/// Settings of LeRobot that recordings do not contain.
#[derive(Debug)]
pub struct Choices<'a> {
    /// Rows a second.
    pub fps: NonZeroU16,
    /// What is done in the recordings, as a sentence.
    pub task: &'a str,
}

/// Writes the data set of these recordings. Returns the number of rows.
pub fn write(recordings: &[Frames<'_>], choices: &Choices<'_>, folder: Folder) -> Result<u64> {
    let mut known: Option<Features> = None;
    let mut stats = stats::Statistics::default();
    let mut episodes = Vec::new();
    let mut rows = 0;
    for (index, frames) in recordings.iter().enumerate() {
        let path = meta::data_path(index);
        let place = || frames.recording().to_string();
        let mut episode = Episode::begin(&folder, path, [index as u64, rows], choices.fps);
        frames.each("exporting", |frame| episode.take(frame, &mut known, &mut stats).with_context(place))?;
        let [length, leaps] = episode.finish(&mut stats).with_context(place)?;
        if leaps > 0 {
            eprintln!("{}: the board's time leaps {leaps} times; there are no rows for the gaps.", place());
        }
        episodes.push(length);
        rows += length;
    }
    let features = known.context("no recording was given")?;
    meta::write(&folder, &features, &stats, &episodes, choices)?;
    folder.keep()?;
    Ok(rows)
}

/// True if a file in a folder is of such a data set.
pub fn is_ours(inside: &Path) -> bool {
    let is_named = |name: &str| inside.extension().is_some_and(|extension| extension == name);
    (inside.starts_with("data") || inside.starts_with("meta")) && (is_named("parquet") || is_named("json"))
}
