//! What `taxel record --view` costs by the number of boards, which other processes play, and that nothing is
//! lost.

mod judged;
pub mod player;
pub mod stream;

use crate::Report;
use crate::chart::{Axis, Better, Chart, Series};
use anyhow::{Context, Result, ensure};
use clap::Args;
use judged::{Judged, judge};
use serde_json::json;
use std::path::{Path, PathBuf};
use stream::Stream;

/// Most of one core, %.
const CORE: f64 = 100.0;
/// Most memory in the last minute against the second one: the index of a recording grows with its chunks.
const FLAT: f64 = 1.1;

/// Arguments of `cargo xtask bench boards`.
#[derive(Debug, Clone, Args)]
pub struct BoardsBench {
    /// Numbers of boards
    #[arg(long, value_name = "N", value_delimiter = ',', default_values_t = [1, 4, 16, 64, 100])]
    boards: Vec<usize>,
    /// Seconds for each number of boards
    #[arg(long, default_value_t = 30.0)]
    seconds: f64,
    /// Seconds for the last number of boards once more, in which the memory must not grow; 0: not at all
    #[arg(long, default_value_t = 600.0)]
    long: f64,
    /// The program [default: taxel beside this one]
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
}

/// Runs all numbers of boards. Error if anything is lost.
pub fn measure(args: &BoardsBench) -> Result<Vec<Judged>> {
    let beside = || Some(std::env::current_exe().ok()?.with_file_name("taxel"));
    let program = args.program.clone().or_else(beside).context("there is no program")?;
    let folder = std::env::temp_dir().join(format!("taxel-boards-{}", std::process::id()));
    std::fs::create_dir_all(&folder).with_context(|| format!("{} cannot be made", folder.display()))?;
    let judged = runs(args, &program, &folder);
    // Nothing was made where it cannot be removed.
    let _ = std::fs::remove_dir_all(&folder);
    judged
}

fn runs(args: &BoardsBench, program: &Path, folder: &Path) -> Result<Vec<Judged>> {
    let mut all = Vec::new();
    let most = &args.boards[args.boards.len().saturating_sub(1)..];
    let long = (args.long > 0.0).then_some((args.long, most));
    for (seconds, numbers) in [(args.seconds, &args.boards[..])].into_iter().chain(long) {
        let stream = Stream::make(folder, seconds)?;
        stream.write(&folder.join("two.stream"))?;
        for boards in numbers {
            all.push(judge(program, folder, &stream, seconds, *boards)?);
        }
    }
    Ok(all)
}

/// The table and its chart.
pub fn report(rows: &[Judged]) -> Report {
    let alone = rows.first().map_or(0.0, |row| row.percent() / row.boards as f64);
    let sum = |row: &Judged| alone * row.boards as f64;
    let mut text = format!(
        "{:>6}  {:>7}  {:>8}  {:>13}  {:>10}  {:>13}  {:>6}  {:>7}\n",
        "boards", "seconds", "frames", "% of one core", "us a frame", "single boards", "MB", "late ms"
    );
    for row in rows {
        text += &format!(
            "{:>6}  {:>7.0}  {:>8}  {:>13.1}  {:>10.1}  {:>13.1}  {:>6.0}  {:>7.1}\n",
            row.boards,
            row.seconds,
            row.each.frames * row.boards as u64,
            row.percent(),
            row.frame_us(),
            sum(row),
            row.memory_mb.iter().copied().fold(0.0, f64::max),
            row.late_ms,
        );
    }
    text += "no contact and no image is lost\n";
    if let Some((row, growth)) = rows.iter().find_map(|row| Some((row, row.growth()?))) {
        let memory: Vec<_> = row.memory_mb.iter().map(|mb| format!("{mb:.0}")).collect();
        text += &format!("memory in the last minute is {growth:.3} of that in the second\n");
        text += &format!("memory each 10 s, MB: {}\n", memory.join(" "));
    }
    let table = rows.iter().map(|row| {
        let most = row.memory_mb.iter().copied().fold(0.0, f64::max);
        json!([
            row.boards,
            row.seconds,
            row.percent(),
            row.frame_us(),
            sum(row),
            most,
            row.written_mb,
            row.viewed_mb
        ])
    });
    let columns = [
        "boards",
        "seconds",
        "percent_of_a_core",
        "us_a_frame",
        "percent_of_single_boards",
        "memory_mb",
        "written_mb",
        "viewed_mb",
    ];
    Report {
        text,
        json: json!({ "columns": columns, "rows": table.collect::<Vec<_>>() }),
        chart: chart(rows, sum),
    }
}

fn chart(rows: &[Judged], sum: impl Fn(&Judged) -> f64) -> Chart {
    let series = |name: &str, percent: &dyn Fn(&Judged) -> f64| Series {
        name: name.into(),
        points: rows
            .iter()
            .map(|row| {
                let percent = percent(row);
                (row.boards as f64, percent, format!("{} boards: {percent:.1} %", row.boards))
            })
            .collect(),
    };
    Chart {
        title: "taxel record --view: boards of 2,048 taxels, 195 frames/s, two contacts".into(),
        x: Axis::new("boards", Better::More),
        y: Axis::new("% of one core", Better::Less),
        named: false,
        series: vec![series("all at once", &Judged::percent), series("sum of single ones", &sum)],
    }
}

/// Error unless it takes one core at most, and the memory is flat.
pub fn keeps(rows: &[Judged]) -> Result<()> {
    for row in rows {
        let (boards, percent) = (row.boards, row.percent());
        ensure!(percent <= CORE, "{boards} boards take {percent:.1} % of a core, {CORE} at most");
        let growth = row.growth().unwrap_or(1.0);
        ensure!(growth <= FLAT, "memory grows: {growth:.2} times that of the second minute, {FLAT} at most");
    }
    Ok(())
}
