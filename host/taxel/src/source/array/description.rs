//! The description of an array: a TOML file, or one that comes with the program.

use super::form::{BytesForm, FrameForm};
use crate::error::{Context, Result, SettingError};
use crate::files::input;
use crate::text::{toml_key, words};
use serde::Deserialize;
use std::path::Path;
use taxel_core::capacity::TAXELS;
use taxel_core::garment::{Orientation, PITCH_UM};

/// Most bytes before, between or behind the values.
const BESIDE: usize = 4096;

/// An array, and how its stream is read.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArrayDescription {
    /// Rows of the panel, after orientation.
    pub rows: u16,
    /// Columns of the panel, after orientation.
    pub columns: u16,
    /// Every second line of the stream runs back.
    #[serde(default)]
    pub snake: bool,
    /// Orientation of the stream's rows and columns on the panel.
    #[serde(default)]
    pub orientation: Orientation,
    /// Values that become codes 0 and 4095; none if the user must say it.
    pub range: Option<[f64; 2]>,
    /// The value falls with pressure.
    #[serde(default)]
    pub falling: bool,
    /// Columns whose change from the start, as one vector, is the value of the row's only taxel; empty if each value
    /// is a taxel's.
    #[serde(default)]
    pub change_of: Vec<u16>,
    /// Distance of columns and of rows, um; none if unknown.
    pub pitch_um: Option<[u32; 2]>,
    /// Unit of the values, for people.
    pub unit: Option<String>,
    /// The serial link.
    #[serde(default)]
    pub link: ArrayLinkSettings,
    /// Form of the frames.
    pub frame: FrameForm,
}

/// Speed of a serial port, and what the host sends.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ArrayLinkSettings {
    /// Bits per second.
    pub baud: u32,
    /// Text that is sent once.
    pub send: Option<String>,
    /// Text that is sent before each frame.
    pub poll: Option<String>,
    /// Shortest time between two polls, ms.
    pub every_ms: u32,
}

impl Default for ArrayLinkSettings {
    fn default() -> ArrayLinkSettings {
        ArrayLinkSettings { baud: 115_200, send: None, poll: None, every_ms: 10 }
    }
}

impl ArrayDescription {
    /// Reads a file. Errors name the file, the line and the key.
    pub fn read(path: impl AsRef<Path>) -> Result<ArrayDescription> {
        let name = path.as_ref().display().to_string();
        let text = input::text(&path).with_context(|| format!("cannot read {name}"))?;
        ArrayDescription::parse(&text, &name)
    }

    /// Reads a text; errors call it by this name.
    pub fn parse(text: &str, name: &str) -> Result<ArrayDescription> {
        let description: ArrayDescription =
            toml::from_str(text).map_err(|error| SettingError::Malformed(words::toml(&error, text, name)))?;
        description.check().map_err(|(key, why)| toml_key::error(name, text, key, why))?;
        Ok(description)
    }

    /// Number of values of a frame.
    pub fn values(&self) -> usize {
        usize::from(self.rows) * usize::from(self.columns)
    }

    /// Rows and columns of taxels.
    pub fn shape(&self) -> [u16; 2] {
        [self.rows, if self.change_of.is_empty() { self.columns } else { 1 }]
    }

    /// Checks its values. Error: the key that is wrong, and why.
    pub fn check(&self) -> Result<(), (&'static str, String)> {
        let wrong = |key, why: &str| Err((key, why.to_string()));
        let values = self.values();
        match (self.rows, self.columns) {
            (0, _) => return wrong("rows", "it must be 1 or more"),
            (_, 0) => return wrong("columns", "it must be 1 or more"),
            _ if values > TAXELS => {
                return Err((
                    "rows",
                    format!("{values} values are more than the {TAXELS} taxels of a board"),
                ));
            }
            _ => {}
        }
        if self.range.is_some_and(|[low, high]| !(low < high && low.is_finite() && high.is_finite())) {
            return wrong("range", "the first of its two numbers must be less than the second");
        }
        if self.pitch_um.is_some_and(|pitch| !pitch.iter().all(|um| (PITCH_UM[0]..=PITCH_UM[1]).contains(um)))
        {
            let [low, high] = PITCH_UM;
            return Err(("pitch_um", format!("both must be {low} to {high}")));
        }
        if self.change_of.iter().any(|column| *column >= self.columns) {
            return wrong("change_of", "it names a column that there is not");
        }
        if self.link.baud == 0 {
            return wrong("link.baud", "it must be 1 or more");
        }
        match &self.frame {
            FrameForm::Bytes(form) => self.check_bytes(form),
            _ if self.link.poll.is_some() => wrong("link.poll", "only frames of kind \"bytes\" are polled"),
            FrameForm::Lines { skip, time, .. } if skip.max(&time.map_or(0, |time| time.field)) > &BESIDE => {
                wrong("frame", "a field has a number of at most 4096")
            }
            FrameForm::Wiresens { nodes, .. } if !(1..=4096).contains(nodes) => {
                wrong("frame.nodes", "it must be 1 to 4096")
            }
            FrameForm::Rows { skip, .. } if *skip > BESIDE => wrong("frame.skip", "it must be at most 4096"),
            _ => Ok(()),
        }
    }

    fn check_bytes(&self, form: &BytesForm) -> Result<(), (&'static str, String)> {
        let wrong = |key, why: &str| Err((key, why.to_string()));
        if !(self.values() * form.value.bits()).is_multiple_of(8) {
            return wrong("frame.value", "the values end within a byte");
        }
        if form.before.max(form.after) > BESIDE {
            return wrong("frame", "`before` and `after` must be at most 4096");
        }
        let record = form.record(self.values())?;
        let length = match &record {
            Some(record) => record.frame.len(),
            None if self.link.poll.is_none() => {
                return wrong(
                    "frame",
                    "without `head` and `tail` in it and `poll` in [link], no frame can be found",
                );
            }
            None => form.before + form.value_bytes(self.values()) + form.after,
        };
        if record.is_none() && (form.check.length() > 0 || form.over.is_some()) {
            return wrong("frame.check", "an answer without `head` or `tail` has no checksum here");
        }
        if let Some(place) = form.sequence
            && (!place.form.counts() || place.at + place.form.bits() / 8 > length)
        {
            return wrong("frame.sequence", "it must be a whole number within the frame");
        }
        if let Some(place) = form.time
            && (!place.form.counts() || place.at + place.form.bits() / 8 > length)
        {
            return wrong("frame.time", "it must be a whole number within the frame");
        }
        Ok(())
    }
}
