//! Touches whose place on the robot is known.

use crate::error::SettingError;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A touch that a panel has felt, and where on the robot it was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownTouch {
    /// Name of the panel.
    pub panel: String,
    /// Centroid, in taxels of the panel: a contact's `x`.
    pub column: f64,
    /// A contact's `y`.
    pub row: f64,
    /// Link of the robot that was touched.
    pub link: String,
    /// Place in the link's frame, m.
    pub x: f64,
    /// See `x`.
    pub y: f64,
    /// See `x`.
    pub z: f64,
}

impl KnownTouch {
    /// Place in the link's frame, m.
    pub fn at(&self) -> DVec3 {
        DVec3::new(self.x, self.y, self.z)
    }
}

/// Reads touches as CSV: a heading `panel,column,row,link,x,y,z`, then a touch a line. Errors name the line.
pub fn known_touches(name: &str, text: &str) -> Result<Vec<KnownTouch>, SettingError> {
    let mut touches = Vec::new();
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let heading = reader.headers().cloned().unwrap_or_default();
    for touch in reader.deserialize() {
        let touch: KnownTouch = touch.map_err(|error| wrong(name, &heading, &error))?;
        let numbers = [touch.column, touch.row, touch.x, touch.y, touch.z];
        if !numbers.iter().all(|number| number.is_finite()) {
            let number = touches.len() + 1;
            return Err(SettingError::Malformed(format!("{name}, touch {number}: not finite")));
        }
        touches.push(touch);
    }
    Ok(touches)
}

/// Returns what the reader of CSV finds wrong, with its line and the name of the column.
fn wrong(name: &str, heading: &csv::StringRecord, error: &csv::Error) -> SettingError {
    let line = error.position().map_or(1, csv::Position::line);
    let what = match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => {
            let field = err.field().and_then(|field| heading.get(usize::try_from(field).ok()?));
            field.map_or(String::new(), |field| format!("`{field}`: ")) + &err.kind().to_string()
        }
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} values, and the heading has {expected_len}")
        }
        _ => error.to_string(),
    };
    SettingError::Malformed(format!("{name}, line {line}: {what}"))
}
