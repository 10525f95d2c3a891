//! The contacts of a frame in a recording.

use super::recorded_contact::RecordedContact;
use crate::json::lines::ContactsLine;
#[cfg(feature = "schema")]
use crate::json::schema::TypeIs;
use serde::Serialize;

/// Contacts that are present, and those that have ended since the last such message.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("contacts")))]
#[serde(tag = "type", rename = "contacts")]
pub struct ContactsMessage<'a> {
    /// Number of the scan.
    frame: u32,
    /// Start of the scan, us of the board.
    time_us: u64,
    /// Present contacts.
    contacts: Vec<RecordedContact<'a>>,
    /// Contacts that have ended; absent if none has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    released: Vec<RecordedContact<'a>>,
    /// Number of contacts that did not fit; absent if all did.
    #[serde(skip_serializing_if = "Option::is_none")]
    dropped: Option<u16>,
}

impl<'a> ContactsMessage<'a> {
    /// The message of a line.
    pub fn of(line: ContactsLine<'a>) -> ContactsMessage<'a> {
        let all = |contacts: Vec<_>| contacts.into_iter().map(RecordedContact::of).collect();
        ContactsMessage {
            frame: line.frame,
            time_us: line.time_us,
            contacts: all(line.contacts),
            released: all(line.released),
            dropped: Some(line.dropped).filter(|dropped| *dropped > 0),
        }
    }
}
