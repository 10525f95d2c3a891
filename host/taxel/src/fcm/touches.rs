//! Labelled touches from a CSV file: a column for each input concept, `label`, and optionally `group`.

use super::board::{BoardMap, MapState};
use super::decimal::Decimal;
use super::map::MapFile;
use crate::error::{Context, Error, MapFileError, Result};
use crate::files::input;
use crate::files::rows::{CsvRow, rows};
use std::path::Path;

/// Label of a touch without any intention of the map.
pub const NONE: &str = "none";

/// One touch.
#[derive(Debug, Clone)]
pub struct Labelled {
    /// Initial state of its inference.
    pub start: MapState,
    /// Index of its class.
    pub class: usize,
    /// Group, such as a person; a cross-validation never splits a group.
    pub group: String,
}

/// All touches of a file.
#[derive(Debug, Clone)]
pub struct Touches {
    /// Labels in the order of their first touch: concepts of the map, or `none`.
    pub classes: Vec<String>,
    /// The touches.
    pub touches: Vec<Labelled>,
}

/// Reads a file for a map.
pub fn read(path: &Path, file: &MapFile, map: &BoardMap) -> Result<Touches> {
    let place = path.display();
    let text = input::text(path).with_context(|| format!("{place}: cannot be read"))?;
    parse(&text, file, map).with_context(|| place.to_string())
}

/// Parses the text of a file.
pub fn parse(text: &str, file: &MapFile, map: &BoardMap) -> Result<Touches> {
    let wrong = |why: String| Error::from(MapFileError::Touches(why));
    let rows = rows(text);
    let (CsvRow { cells: header, .. }, rows) =
        rows.split_first().ok_or_else(|| wrong("it is empty".into()))?;
    let column = |name: &str| header.iter().position(|cell| cell == name);
    let label = column("label").ok_or_else(|| wrong("line 1: there is no column label".into()))?;
    let group = column("group");
    let mut inputs = Vec::new();
    for (at, name) in header.iter().enumerate().filter(|(at, _)| *at != label && Some(*at) != group) {
        let concept = file
            .find(name)
            .ok_or_else(|| wrong(format!("line 1: column {name} is not a concept of the map")))?;
        if file.is_driven(name) {
            fail!(MapFileError::Touches, "line 1: column {name} is a concept that has causes");
        }
        inputs.push((at, concept));
    }
    let mut found = Touches { classes: Vec::new(), touches: Vec::new() };
    for CsvRow { line, cells: row } in rows {
        if row.len() != header.len() {
            fail!(
                MapFileError::Touches,
                "line {line}: {} values, and there are {} columns",
                row.len(),
                header.len()
            );
        }
        let mut activations = Vec::new();
        for (cell, concept) in &inputs {
            let value = Decimal::parse(&row[*cell]).filter(|value| value.is_fraction());
            let (name, text) = (&header[*cell], &row[*cell]);
            let unfit = || wrong(format!("line {line}: {name} = {text:?} is not a number in -1 ..= 1"));
            activations.push((*concept, value.ok_or_else(unfit)?));
        }
        let class = found.class(&row[label], file).with_context(|| format!("line {line}"))?;
        let group = group.map_or(String::new(), |group| row[group].to_string());
        found.touches.push(Labelled { start: map.state(activations), class, group });
    }
    match found.classes.len() {
        0 | 1 => fail!(MapFileError::Touches, "there must be touches of at least two labels"),
        _ => Ok(found),
    }
}

impl Touches {
    fn class(&mut self, label: &str, file: &MapFile) -> Result<usize> {
        if let Some(class) = self.classes.iter().position(|class| class == label) {
            return Ok(class);
        }
        if label != NONE && !file.is_driven(label) {
            fail!(MapFileError::Touches, "label {label} is neither a concept with causes nor {NONE}");
        }
        self.classes.push(label.into());
        Ok(self.classes.len() - 1)
    }

    /// Fold of each touch in a cross-validation with `folds` folds: by group if there are groups, else in
    /// turn by class.
    pub fn folds(&self, folds: usize) -> Vec<usize> {
        let mut groups: Vec<&str> = self.touches.iter().map(|touch| touch.group.as_str()).collect();
        groups.sort_unstable();
        groups.dedup();
        let mut seen = vec![0; self.classes.len()];
        let fold = |touch: &Labelled| match groups.len() {
            1 => {
                seen[touch.class] += 1;
                (seen[touch.class] - 1) % folds
            }
            _ => groups.iter().position(|group| *group == touch.group).unwrap_or(0) % folds,
        };
        self.touches.iter().map(fold).collect()
    }
}
