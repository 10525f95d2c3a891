//! Metadata of the data set.

use super::features::Features;
use super::parquet::{Column, ColumnType, Table, Values};
use super::{CHUNK, Choices, stats};
use anyhow::{Context, Result};
use serde_json::{Value, json};
use std::io::Write;
use taxel::files::output::Folder;

/// Size of a file at which LeRobot begins another, MB; ours end with their episode.
const DATA_MB: u32 = 100;

/// Path of an episode's file.
pub fn data_path(episode: usize) -> String {
    format!("data/chunk-{:03}/file-{:03}.parquet", episode / CHUNK, episode % CHUNK)
}

/// Writes the folder `meta`; `episodes` has the number of rows of each.
pub fn write(
    folder: &Folder,
    features: &Features,
    stats: &stats::Statistics,
    episodes: &[u64],
    choices: &Choices<'_>,
) -> Result<()> {
    tasks(folder, choices.task)?;
    list(folder, episodes, choices.task)?;
    let shapes = features.columns().into_iter().map(|column| match column.kind {
        ColumnType::Floats(shape) => (column.name, shape),
        _ => (column.name, vec![1]),
    });
    let all: serde_json::Map<_, _> =
        shapes.map(|(name, shape)| (name.clone(), stats.of(&name, &shape))).collect();
    put(folder, "meta/stats.json", &Value::Object(all))?;
    put(
        folder,
        "meta/info.json",
        &json!({
            "codebase_version": "v3.0",
            "robot_type": null,
            "total_episodes": episodes.len(),
            "total_frames": episodes.iter().sum::<u64>(),
            "total_tasks": 1,
            "chunks_size": CHUNK,
            "data_files_size_in_mb": DATA_MB,
            "video_files_size_in_mb": 2 * DATA_MB,
            "fps": choices.fps,
            "splits": { "train": format!("0:{}", episodes.len()) },
            "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
            "video_path": null,
            "features": features.described(),
        }),
    )
}

fn put(folder: &Folder, path: &str, value: &Value) -> Result<()> {
    let text = serde_json::to_string_pretty(value)?;
    let mut file = folder.file(path)?;
    let done = file.write_all(text.as_bytes()).and_then(|()| file.flush());
    done.with_context(|| format!("{path} cannot be written"))
}

/// The single task. LeRobot reads it with pandas, by its index.
fn tasks(folder: &Folder, task: &str) -> Result<()> {
    let column = |name: &str, kind| Column { name: name.into(), kind };
    let columns = vec![column("task_index", ColumnType::Whole), column("task", ColumnType::Text)];
    let described = |name: &str, pandas: &str, numpy: &str| json!({ "name": name, "field_name": name, "pandas_type": pandas, "numpy_type": numpy, "metadata": null });
    let pandas = json!({
        "index_columns": ["task"],
        "column_indexes": [],
        "columns": [described("task_index", "int64", "int64"), described("task", "unicode", "object")],
        "creator": { "library": "taxel", "version": env!("CARGO_PKG_VERSION") },
        "pandas_version": "2.0.0",
    });
    let mut table =
        Table::create(folder, "meta/tasks.parquet", columns, Some(["pandas".into(), pandas.to_string()]))?;
    table.rows(&[Values::Whole(vec![0]), Values::Texts(vec![task.into()])])?;
    table.finish()
}

/// Place of each episode.
fn list(folder: &Folder, episodes: &[u64], task: &str) -> Result<()> {
    let starts = episodes.iter().scan(0, |next, length| Some(std::mem::replace(next, *next + *length)));
    let starts: Vec<i64> = starts.map(|start| start as i64).collect();
    let count = episodes.len();
    let lengths: Vec<i64> = episodes.iter().map(|length| *length as i64).collect();
    let ends = starts.iter().zip(&lengths).map(|(start, length)| start + length).collect();
    let each = |number: fn(usize) -> usize| (0..count).map(|episode| number(episode) as i64).collect();
    let whole: [(&str, Vec<i64>); 8] = [
        ("episode_index", each(|episode| episode)),
        ("data/chunk_index", each(|episode| episode / CHUNK)),
        ("data/file_index", each(|episode| episode % CHUNK)),
        ("meta/episodes/chunk_index", vec![0; count]),
        ("meta/episodes/file_index", vec![0; count]),
        ("dataset_from_index", starts),
        ("dataset_to_index", ends),
        ("length", lengths),
    ];
    let mut columns: Vec<_> =
        whole.iter().map(|(name, _)| Column { name: name.to_string(), kind: ColumnType::Whole }).collect();
    columns.push(Column { name: "tasks".into(), kind: ColumnType::Texts });
    let mut values: Vec<_> = whole.into_iter().map(|(_, numbers)| Values::Whole(numbers)).collect();
    values.push(Values::Texts(vec![task.into(); count]));
    let mut table = Table::create(folder, "meta/episodes/chunk-000/file-000.parquet", columns, None)?;
    table.rows(&values)?;
    table.finish()
}
