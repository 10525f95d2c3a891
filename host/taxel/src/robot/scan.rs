//! What the robot's contacts are made of: the contacts of a board's scan.

use crate::client::{Client, Event};
use taxel_core::contact::Contact;

/// A scan of a board.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardScan {
    /// Its contacts; none if they were not told with it.
    pub contacts: Option<Vec<Contact>>,
}

impl BoardScan {
    /// Of an event, which the client already includes; none if it is not about a scan.
    pub fn of(client: &Client, event: &Event) -> Option<BoardScan> {
        let told = || client.contacts().iter().map(|placed| placed.contact.clone()).collect();
        match event {
            Event::Contacts { .. } => Some(BoardScan { contacts: Some(told()) }),
            Event::Frame { .. } => Some(BoardScan { contacts: None }),
            _ => None,
        }
    }
}
