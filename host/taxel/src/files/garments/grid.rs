//! A garment file without wiring: one grid of taxels, whose codes come from elsewhere.

use crate::error::SettingError;
use crate::text::{toml_key, words};
use serde::{Deserialize, Serialize};
use taxel_core::format::Name;
use taxel_core::garment::Garment;

/// Keys of a garment with wiring, which `grid` takes the place of.
const WIRED: [&str; 5] = ["wiring", "panels", "blocks", "seams", "absent"];

/// A garment file with `[grid]`.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridFile {
    name: Name,
    grid: GridPanel,
}

/// The grid.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct GridPanel {
    rows: u16,
    columns: u16,
    /// Distance of columns and of rows, um; 0 if unknown.
    #[serde(default)]
    pitch_um: [u32; 2],
}

impl GridFile {
    /// True if a file has a grid.
    pub fn is_one(text: &str) -> bool {
        text.parse::<toml::Table>().is_ok_and(|table| table.contains_key("grid"))
    }

    /// Reads a file that has a grid.
    pub fn read(text: &str, name: &str) -> Result<Garment, SettingError> {
        let table = text.parse::<toml::Table>().unwrap_or_default();
        if let Some(key) = WIRED.into_iter().find(|key| table.contains_key(*key)) {
            let why = "a garment has either wiring and panels, or [grid]";
            return Err(toml_key::error(name, text, key, why));
        }
        let file: GridFile =
            toml::from_str(text).map_err(|error| SettingError::Malformed(words::toml(&error, text, name)))?;
        let GridPanel { rows, columns, pitch_um } = file.grid;
        Ok(Garment::grid(&file.name, rows, columns, pitch_um))
    }

    /// The file of a garment that is nothing but a grid; none of another.
    pub fn of(garment: &Garment) -> Option<GridFile> {
        let [panel] = garment.panels.as_slice() else { return None };
        let (rows, columns, pitch_um) = (panel.rows, panel.columns, panel.pitch_um);
        let is_grid = *garment == Garment::grid(&garment.name, rows, columns, pitch_um);
        is_grid.then(|| GridFile { name: garment.name.clone(), grid: GridPanel { rows, columns, pitch_um } })
    }
}

/// Path of a key of the garment in a file with a grid.
pub(crate) fn key_in(path: &str) -> String {
    path.strip_prefix("panels[0]").map_or(path.into(), |rest| format!("grid{rest}"))
}

#[cfg(test)]
mod tests {
    use super::super::{parse, text};
    use super::*;

    const TEXT: &str = "name = \"mat\"\n\n[grid]\nrows = 12\ncolumns = 21\npitch_um = [5000, 8000]\n";

    fn refused(from: &str, to: &str) -> String {
        assert!(TEXT.contains(from));
        parse(&TEXT.replace(from, to), "mat.toml").unwrap_err().to_string()
    }

    #[test]
    fn a_grid_is_read_and_written_back() {
        let garment = parse(TEXT, "mat.toml").unwrap();
        assert_eq!(garment, Garment::grid("mat", 12, 21, [5000, 8000]));
        assert_eq!(text(&garment, "a mat").unwrap(), format!("# a mat\n{TEXT}"));
        // Anything else keeps its panels.
        let mut named = garment.clone();
        named.panels[0].name = taxel_core::format::name("sole");
        let written = text(&named, "").unwrap();
        assert!(written.contains("[[panels]]") && parse(&written, "").unwrap() == named, "{written}");
    }

    #[test]
    fn errors_name_the_key() {
        assert_eq!(
            refused("[grid]", "blocks = []\n[grid]"),
            "mat.toml, line 3, `blocks`: a garment has either wiring and panels, or [grid]"
        );
        assert!(
            refused("rows", "row")
                .starts_with("mat.toml, line 4: `row` is not a known key, did you mean `rows`?")
        );
        assert!(refused("columns = 21\n", "").contains("`columns` is missing"));
        assert_eq!(key_in("panels[0].rows"), "grid.rows");
    }
}
