//! Lines of numbers.

use super::frame::StreamFrame;
use super::stamp::TimeUnit;

/// Form of a line of numbers.
#[derive(Debug, Clone)]
pub struct LineForm {
    /// Text between numbers; none for spaces, tabs, commas and semicolons in a row.
    pub separator: Option<String>,
    /// Text at the start of a line with numbers; other lines are ignored.
    pub prefix: Option<String>,
    /// Field of the sensor's time, counted behind the prefix, and its unit.
    pub time: Option<(usize, TimeUnit)>,
    /// Further leading fields that are no values.
    pub skip: usize,
}

/// Contents of a line.
#[derive(Debug, PartialEq)]
pub enum LineKind {
    /// No text.
    Empty,
    /// Without the prefix.
    Other,
    /// Something else than numbers.
    Damaged,
    /// Its numbers are appended.
    Numbers,
}

impl LineForm {
    /// Appends the numbers of a line to the frame.
    pub fn read(&self, line: &[u8], frame: &mut StreamFrame) -> LineKind {
        let Ok(text) = std::str::from_utf8(line) else { return LineKind::Damaged };
        let text = text.trim();
        if text.is_empty() {
            return LineKind::Empty;
        }
        let separator = self.separator.as_deref().filter(|text| !text.trim().is_empty());
        let Some(text) = text.strip_prefix(self.prefix.as_deref().unwrap_or("")) else {
            return LineKind::Other;
        };
        match separator {
            Some(separator) => {
                let text = text.trim();
                // A separator may follow the prefix, and the last number.
                let text = self.prefix.as_ref().and_then(|_| text.strip_prefix(separator)).unwrap_or(text);
                let text = text.strip_suffix(separator).unwrap_or(text);
                self.fields(text.split(separator).map(str::trim), frame)
            }
            None => {
                let between = |sign: char| sign.is_whitespace() || matches!(sign, ',' | ';');
                self.fields(text.split(between).filter(|word| !word.is_empty()), frame)
            }
        }
    }

    fn fields<'a>(&self, fields: impl Iterator<Item = &'a str>, frame: &mut StreamFrame) -> LineKind {
        let mut skip = self.skip;
        for (at, field) in fields.enumerate() {
            let number = field.parse::<f64>().ok();
            match self.time {
                Some((place, unit)) if place == at => {
                    let Some(time) = number.filter(|time| *time >= 0.0) else { return LineKind::Damaged };
                    frame.time_us = Some((time * unit.us() as f64) as u64);
                }
                _ if skip > 0 => skip -= 1,
                _ => match number {
                    Some(value) => frame.values.push(value),
                    None => return LineKind::Damaged,
                },
            }
        }
        LineKind::Numbers
    }
}
