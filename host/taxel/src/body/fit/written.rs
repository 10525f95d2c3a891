//! The body file that says how the panels are worn.

use super::found::PatchFit;
use crate::error::SettingError;
use toml_edit::{DocumentMut, InlineTable, Item, Value};

/// The text of a body file with `worn` of these panels, to 10 um and a hundredth of a degree. Its comments
/// stay.
pub(in crate::body) fn written(name: &str, text: &str, panels: &[PatchFit]) -> Result<String, SettingError> {
    let malformed = |what: String| SettingError::Malformed(format!("{name}: {what}"));
    let mut document: DocumentMut =
        text.parse().map_err(|error: toml_edit::TomlError| malformed(error.to_string()))?;
    for fit in panels {
        let rounded = |number: f64, parts: f64| (number * parts).round() / parts + 0.0;
        let mut worn = InlineTable::new();
        worn.insert("right", rounded(fit.worn.right, 1e5).into());
        worn.insert("down", rounded(fit.worn.down, 1e5).into());
        worn.insert("turn", rounded(fit.worn.turn, 1e2).into());
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
        patch.insert("worn", Item::Value(Value::InlineTable(worn)));
    }
    Ok(document.to_string())
}
