//! A data set as LeRobot reads it (LeRobotDataset v3.0): one recording becomes one episode.
//!
//! | file | holds |
//! |---|---|
//! | `meta/info.json` | frames a second, and of each feature its type and shape; of a panel also unit, link and pitch |
//! | `meta/stats.json` | least, greatest, mean and spread of each feature, element by element |
//! | `meta/tasks.parquet`, `meta/episodes/chunk-000/file-000.parquet` | the task; where each episode lies |
//! | `data/chunk-000/file-000.parquet`, `file-001.parquet`, ... | an episode, one row a frame |
//!
//! | feature | type, shape | what |
//! |---|---|---|
//! | `observation.tactile.PANEL` | f32 \[rows, columns\] | pressure in the panel's unit; a name's other signs than letters and digits become `_` |
//! | `observation.tactile.intent` | f32 \[concepts\] | activation of each concept of the map, -1 ..= 1, where there is one |
//! | `timestamp`, `frame_index`, `episode_index`, `index`, `task_index` | f32, i64 | LeRobot's own |
//!
//! LeRobot wants whole frames a second, evenly: a row is the last image at its time, by the board's clock; see
//! `sampler.rs` for what a leap of that clock becomes.

mod episode;
mod features;
mod meta;
mod parquet;
mod sampler;
mod stats;

use super::frames::Frames;
use crate::output::Folder;
use anyhow::{Context, Result};
use episode::Episode;
use features::Features;
use std::num::NonZeroU16;
use std::path::Path;

/// Episodes, and so files, of a folder.
const CHUNK: usize = 1000;

/// What LeRobot wants to know beside the recordings.
#[derive(Debug)]
pub struct Choices<'a> {
    /// Rows a second.
    pub fps: NonZeroU16,
    /// What is done in the recordings, in a sentence.
    pub task: &'a str,
}

/// Writes the data set of these recordings; the number of rows.
pub fn write(recordings: &[Frames<'_>], choices: &Choices<'_>, folder: Folder) -> Result<u64> {
    let mut known: Option<Features> = None;
    let mut stats = stats::Table::default();
    let mut episodes = Vec::new();
    let mut rows = 0;
    for (index, frames) in recordings.iter().enumerate() {
        let path = meta::data_path(index);
        let place = || frames.file().display().to_string();
        let mut episode = Episode::begin(&folder, path, [index as u64, rows], choices.fps);
        frames.each("exporting", |frame| episode.take(frame, &mut known, &mut stats).with_context(place))?;
        let [length, leaps] = episode.finish(&mut stats).with_context(place)?;
        if leaps > 0 {
            eprintln!(
                "{}: the board's time leaps {leaps} times, and no row stands for what lies between.",
                place()
            );
        }
        episodes.push(length);
        rows += length;
    }
    let features = known.context("no recording is given")?;
    meta::write(&folder, &features, &stats, &episodes, choices)?;
    folder.keep()?;
    Ok(rows)
}

/// Whether a file of a folder is one of a data set.
pub fn is_ours(inside: &Path) -> bool {
    let is_named = |name: &str| inside.extension().is_some_and(|extension| extension == name);
    (inside.starts_with("data") || inside.starts_with("meta")) && (is_named("parquet") || is_named("json"))
}
