//! CSV file of labels for a file of images.

use anyhow::{Context, Result, anyhow, bail, ensure};
use std::path::Path;
use taxel::files::input;
use taxel::files::rows::{CsvRow, rows};

/// Class of each of `count` images: a column `index` (from 0), and the last other column for the name.
pub fn read(path: &Path, count: usize) -> Result<Vec<String>> {
    let parse = || {
        let text = input::text(path).context("cannot be read")?;
        let rows = rows(&text);
        let (CsvRow { cells: head, .. }, rows) = rows.split_first().ok_or_else(|| anyhow!("is empty"))?;
        let index =
            head.iter().position(|name| name == "index").ok_or_else(|| anyhow!("has no column `index`"))?;
        let class = (0..head.len())
            .rfind(|column| *column != index)
            .ok_or_else(|| anyhow!("has no column of names"))?;
        let mut names = vec![None; count];
        for CsvRow { line, cells } in rows {
            let (have, want) = (cells.len(), head.len());
            ensure!(have == want, "line {line}: has {have} cells, expected {want}");
            let Ok(at) = cells[index].parse::<usize>() else {
                bail!("line {line}: {:?} is not an index", &cells[index])
            };
            let slot = names
                .get_mut(at)
                .ok_or_else(|| anyhow!("line {line}: there are {count} images, none has index {at}"))?;
            ensure!(slot.replace(cells[class].to_string()).is_none(), "line {line}: index {at} occurs twice");
        }
        let missing = |at: usize| anyhow!("image {at} has no label");
        names.into_iter().enumerate().map(|(at, name)| name.ok_or_else(|| missing(at))).collect()
    };
    parse().with_context(|| path.display().to_string())
}
