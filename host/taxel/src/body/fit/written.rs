//! The body file that says how the panels sit.

use super::found::PatchFit;
use crate::error::SettingError;
use toml_edit::{DocumentMut, InlineTable, Item, Value};

/// The text of a body file with `offset` of these panels, to 10 um and a hundredth of a degree. Its comments
/// stay.
pub(in crate::body) fn written(name: &str, text: &str, panels: &[PatchFit]) -> Result<String, SettingError> {
    let malformed = |what: String| SettingError::Malformed(format!("{name}: {what}"));
    let mut document: DocumentMut =
        text.parse().map_err(|error: toml_edit::TomlError| malformed(error.to_string()))?;
    for fit in panels {
        let rounded = |number: f64, parts: f64| (number * parts).round() / parts + 0.0;
        let mut offset = InlineTable::new();
        offset.insert("right", rounded(fit.offset.right, 1e5).into());
        offset.insert("down", rounded(fit.offset.down, 1e5).into());
        offset.insert("turn", rounded(fit.offset.turn, 1e2).into());
        let patch = document.get_mut("patches").and_then(|patches| match patches {
            Item::ArrayOfTables(tables) => {
                tables.get_mut(fit.patch).map(|table| table as &mut dyn toml_edit::TableLike)
            }
            Item::Value(Value::Array(list)) => {
                let table = list.get_mut(fit.patch)?.as_inline_table_mut()?;
                Some(table as &mut dyn toml_edit::TableLike)
            }
            _ => None,
        });
        let patch = patch.ok_or_else(|| malformed(format!("it has no patch of panel {}", fit.panel)))?;
        patch.insert("offset", Item::Value(Value::InlineTable(offset)));
    }
    Ok(document.to_string())
}
