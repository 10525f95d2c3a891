//! CSV files with named columns.

use anyhow::{Context, Result, ensure};
use std::path::Path;

/// Rows of texts, as long as the header. Quoted fields are not supported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    names: Vec<String>,
    lines: Vec<Vec<String>>,
}

impl Table {
    /// Reads a file. Errors name it.
    pub fn read(path: &Path) -> Result<Table> {
        crate::tell::verbose::reads(path);
        let text = std::fs::read_to_string(path).context("cannot be read");
        text.and_then(|text| Table::parse(&text)).with_context(|| path.display().to_string())
    }

    /// Parses a text.
    pub fn parse(text: &str) -> Result<Table> {
        let split = |line: &str| line.split(',').map(|field| field.trim().to_string()).collect::<Vec<_>>();
        let mut lines = text.trim_start_matches('\u{feff}').lines().map(split);
        let names = lines.next().context("is empty")?;
        let lines: Vec<_> = lines.filter(|line| line.iter().any(|field| !field.is_empty())).collect();
        for (number, line) in lines.iter().enumerate() {
            let (have, want) = (line.len(), names.len());
            ensure!(have == want, "line {}: {have} fields, the first line names {want}", number + 2);
        }
        Ok(Table { names, lines })
    }

    /// Number of rows below the header.
    pub fn len(&self) -> usize {
        self.lines.len()
    }

    /// True if there is no row below the header.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Fields of a column.
    pub fn column(&self, name: &str) -> Result<Vec<&str>> {
        let index = self.names.iter().position(|known| known == name);
        let index =
            index.with_context(|| format!("has no column {name}, known are {}", self.names.join(", ")))?;
        Ok(self.lines.iter().map(|line| line[index].as_str()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_by_name() {
        let table = Table::parse("\u{feff}index,gesture\n0,pat\n\n1, rub\n").unwrap();
        assert_eq!((table.len(), table.column("gesture").unwrap()), (2, vec!["pat", "rub"]));
        let sentence = |text: &str| Table::parse(text).unwrap_err().to_string();
        assert_eq!(
            table.column("label").unwrap_err().to_string(),
            "has no column label, known are index, gesture"
        );
        assert_eq!(
            (sentence(""), sentence("a,b\n1")),
            ("is empty".into(), "line 2: 1 fields, the first line names 2".into())
        );
    }
}
