//! Files of tables of folds, as `taxel body learn` writes them.

use super::input;
use crate::error::{Context, Result, SettingError};
use std::path::Path;
use taxel_core::fold::FoldTable;
use taxel_core::garment::Layout;

/// Reads a table, which the board checks.
pub fn read(file: &Path) -> Result<Vec<u8>> {
    input::bytes(file).with_context(|| format!("{} cannot be read", file.display()))
}

/// Checks the table of a file for a garment of this layout. The error names the file.
pub fn check(file: &Path, table: &[u8], layout: &Layout) -> Result<()> {
    match FoldTable::check(table, layout) {
        Ok(_) => Ok(()),
        Err(error) => fail!(SettingError::Folds, "{}: {error}", file.display()),
    }
}
