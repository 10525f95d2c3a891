//! CSV file of labels for a file of images.

use anyhow::{Context, Result, bail, ensure};
use std::path::Path;

/// Class of each of `count` images: a column `index` (from 0), and the last other column for the name.
pub fn read(path: &Path, count: usize) -> Result<Vec<String>> {
    let parse = || {
        crate::tell::verbose::reads(path);
        let text = std::fs::read_to_string(path).context("cannot be read")?;
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let (_, head) = lines.next().context("is empty")?;
        let head: Vec<&str> = head.split(',').map(str::trim).collect();
        let index = head.iter().position(|name| *name == "index").context("has no column `index`")?;
        let class = (0..head.len()).rfind(|column| *column != index).context("has no column of names")?;
        let mut names = vec![None; count];
        for (number, line) in lines {
            let line_number = number + 1;
            let cells: Vec<&str> = line.split(',').map(str::trim).collect();
            ensure!(
                cells.len() == head.len(),
                "line {line_number}: has {} cells, expected {}",
                cells.len(),
                head.len()
            );
            let Ok(at) = cells[index].parse::<usize>() else {
                bail!("line {line_number}: {:?} is not an index", cells[index])
            };
            let slot = names.get_mut(at).with_context(|| {
                format!("line {line_number}: there are {count} images, none has index {at}")
            })?;
            ensure!(
                slot.replace(cells[class].to_string()).is_none(),
                "line {line_number}: index {at} occurs twice"
            );
        }
        let missing = |at: usize| format!("image {at} has no label");
        names.into_iter().enumerate().map(|(at, name)| name.with_context(|| missing(at))).collect()
    };
    parse().with_context(|| path.display().to_string())
}
