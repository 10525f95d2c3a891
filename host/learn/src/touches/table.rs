//! CSV files with named columns.

use anyhow::{Context, Result, anyhow, ensure};
use csv::StringRecord;
use std::path::Path;
use taxel::files::input;
use taxel::files::rows::{CsvRow, rows};

/// Rows of texts, as long as the header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    names: StringRecord,
    rows: Vec<StringRecord>,
}

impl Table {
    /// Reads a file. Errors name it.
    pub fn read(path: &Path) -> Result<Table> {
        let text = input::text(path).context("cannot be read");
        text.and_then(|text| Table::parse(&text)).with_context(|| path.display().to_string())
    }

    /// Parses a text.
    pub fn parse(text: &str) -> Result<Table> {
        let mut rows = rows(text).into_iter();
        let names = rows.next().ok_or_else(|| anyhow!("is empty"))?.cells;
        let rows: Vec<_> = rows.filter(|row| row.cells.iter().any(|field| !field.is_empty())).collect();
        for CsvRow { line, cells } in &rows {
            let (have, want) = (cells.len(), names.len());
            ensure!(have == want, "line {line}: {have} fields, the first line names {want}");
        }
        Ok(Table { names, rows: rows.into_iter().map(|row| row.cells).collect() })
    }

    /// Number of rows below the header.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// True if there is no row below the header.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Fields of a column.
    pub fn column(&self, name: &str) -> Result<Vec<&str>> {
        let index = self.names.iter().position(|known| known == name);
        let known = || self.names.iter().collect::<Vec<_>>().join(", ");
        let index = index.ok_or_else(|| anyhow!("has no column {name}, known are {}", known()))?;
        Ok(self.rows.iter().map(|row| &row[index]).collect())
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
            (sentence(""), sentence("a,b\n\n1")),
            ("is empty".into(), "line 3: 1 fields, the first line names 2".into())
        );
    }
}
