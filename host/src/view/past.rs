//! The half minute before a page came: its images, so that a page that is loaded again can step back through
//! them, too.

use super::mailbox::{Mailbox, Parcel, Shot};
use super::message;
use crate::client::{Client, Event, ImageNews};
use serde_json::json;
use taxel_core::format::Micros;

/// Shortest time between two images, us of the board: what a page draws.
const PERIOD: u64 = 16_500;

/// Tells images of before, oldest first, by way of a mailbox of its own.
pub struct Past<'a> {
    bytes: std::slice::Iter<'a, u8>,
    client: Client,
    mailbox: Mailbox,
    last: Option<Micros>,
}

impl<'a> Past<'a> {
    /// Of what [`super::Recent::recording`] gives.
    pub fn of(bytes: &'a [u8]) -> Past<'a> {
        Past { bytes: bytes.iter(), client: Client::new(), mailbox: Mailbox::default(), last: None }
    }

    /// Takes an image; whether it is time to tell it.
    fn take(&mut self, event: &Event) -> bool {
        let Event::Frame { time, image: ImageNews::Whole, .. } = event else { return false };
        let Some((_, image)) = self.client.image() else { return false };
        let total = self.client.contacts().iter().fold(0u32, |sum, p| sum.saturating_add(p.contact.total));
        let mut line = message::frame(&self.client, event);
        line["past"] = json!(true);
        self.mailbox.shot(&Shot {
            line: line.to_string().into(),
            image: image.into(),
            time_us: time.0,
            total,
        });
        let due = self.last.is_none_or(|last| time.since(last) >= PERIOD || *time < last);
        if due {
            self.last = Some(*time);
        }
        due
    }
}

impl Iterator for Past<'_> {
    type Item = Parcel;

    fn next(&mut self) -> Option<Parcel> {
        loop {
            let event = self.client.push(*self.bytes.next()?);
            if event.is_some_and(|event| self.take(&event)) {
                return self.mailbox.take();
            }
        }
    }
}
