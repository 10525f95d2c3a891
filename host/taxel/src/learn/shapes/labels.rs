//! CSV file of labels for a file of images.

use crate::error::{Context, LearnError, Result};
use crate::files::input;
use crate::files::rows::{CsvRow, rows};
use std::path::Path;

/// Class of each of `count` images: a column `index` (from 0), and the last other column for the name.
pub fn read(path: &Path, count: usize) -> Result<Vec<String>> {
    let parse = || {
        let text = input::text(path).context("cannot be read")?;
        let lacks = |why: &str| LearnError::Data(why.into());
        let rows = rows(&text);
        let (CsvRow { cells: head, .. }, rows) = rows.split_first().ok_or_else(|| lacks("is empty"))?;
        let index =
            head.iter().position(|name| name == "index").ok_or_else(|| lacks("has no column `index`"))?;
        let class = (0..head.len())
            .rfind(|column| *column != index)
            .ok_or_else(|| lacks("has no column of names"))?;
        let mut names = vec![None; count];
        for CsvRow { line, cells } in rows {
            let (have, want) = (cells.len(), head.len());
            require!(have == want, LearnError::Data, "line {line}: has {have} cells, expected {want}");
            let Ok(at) = cells[index].parse::<usize>() else {
                fail!(LearnError::Data, "line {line}: {:?} is not an index", &cells[index])
            };
            let slot = names.get_mut(at).ok_or_else(|| {
                error!(LearnError::Data, "line {line}: there are {count} images, none has index {at}")
            })?;
            require!(
                slot.replace(cells[class].to_string()).is_none(),
                LearnError::Data,
                "line {line}: index {at} occurs twice"
            );
        }
        let missing = |at: usize| error!(LearnError::Data, "image {at} has no label");
        names.into_iter().enumerate().map(|(at, name)| name.ok_or_else(|| missing(at))).collect()
    };
    parse().with_context(|| path.display().to_string())
}
