//! Files that are attached to a recording.

use super::records::Records;
use super::scan::Scan;
use anyhow::{Context, Result};
use mcap::parse_record;
use mcap::records::Record;
use std::path::Path;

impl Scan {
    /// What is attached under that name, the newest; none: nothing is. `path` is the file that was scanned.
    pub fn attached(&self, path: &Path, name: &str) -> Result<Option<Vec<u8>>> {
        let place = || format!("{}: {name} that is attached cannot be read", path.display());
        let Some(index) = self.contents.attachments.iter().rfind(|index| index.name == name) else {
            return Ok(None);
        };
        let mut records = Records::open_at(path, index.offset)?;
        let record = records.next_record()?.with_context(place)?;
        match parse_record(record.op, record.body).with_context(place)? {
            Record::Attachment { data, .. } => Ok(Some(data.into_owned())),
            _ => Ok(None),
        }
    }
}
