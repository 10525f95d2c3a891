//! Rows of a CSV text, each with the line on which it begins.

use csv::{ReaderBuilder, StringRecord, Trim};

/// A row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CsvRow {
    /// Number of its first line, from 1.
    pub line: usize,
    /// Cells, without the space around them.
    pub cells: StringRecord,
}

/// All rows of a text, of any lengths; blank lines are left out.
pub fn rows(text: &str) -> Vec<CsvRow> {
    let text = text.trim_start_matches('\u{feff}');
    let mut reader =
        ReaderBuilder::new().has_headers(false).flexible(true).trim(Trim::All).from_reader(text.as_bytes());
    let (mut line, mut counted) = (1, 0);
    let row = |cells: StringRecord| {
        // The reader's own number is that of the blank lines before a row.
        let before = cells.position().map_or(0, |place| place.byte() as usize);
        let rest = text.get(before..).unwrap_or_default();
        let start = before + rest.len() - rest.trim_start_matches(['\r', '\n']).len();
        line += text.as_bytes().iter().take(start).skip(counted).filter(|byte| **byte == b'\n').count();
        counted = start;
        CsvRow { line, cells }
    };
    // Nothing can fail: the text is UTF-8, in memory, and rows have any length.
    reader.records().map_while(Result::ok).map(row).filter(|row| !is_blank(&row.cells)).collect()
}

fn is_blank(cells: &StringRecord) -> bool {
    cells.len() <= 1 && cells.iter().all(str::is_empty)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_have_the_numbers_of_their_lines() {
        let text = "\u{feff}a, b\r\n\r\n1,\"x, y\"\r\n   \n\n\n 2 ,\"two\nlines\"\n3\n";
        let found = rows(text);
        let found: Vec<_> =
            found.iter().map(|row| (row.line, row.cells.iter().collect::<Vec<_>>())).collect();
        let want =
            [(1, vec!["a", "b"]), (3, vec!["1", "x, y"]), (7, vec!["2", "two\nlines"]), (9, vec!["3"])];
        assert_eq!(found, want);
        assert_eq!((rows(""), rows("\n \n")), (vec![], vec![]));
    }
}
