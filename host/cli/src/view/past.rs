//! Images of the half minute before a page was opened, so that a reloaded page can step back through them.

use super::hub::PageHub;
use super::lines::PageFrame;
use super::mailbox::{Mailbox, Parcel};
use super::message;
use super::shot::{Shot, text};
use taxel::client::{Client, Event, ImageNews};
use taxel_core::format::Micros;

/// Shortest time between two images, us of the board: that of a page's display.
const PERIOD: u64 = 16_500;

/// Returns earlier images, oldest first, by way of a mailbox of its own.
pub struct Past<'a> {
    bytes: std::slice::Iter<'a, u8>,
    client: Client,
    mailbox: Mailbox,
    last: Option<Micros>,
    hub: &'a PageHub,
}

impl<'a> Past<'a> {
    /// Reads the result of [`super::Recent::recording`].
    pub fn of(bytes: &'a [u8], hub: &'a PageHub) -> Past<'a> {
        let mut client = Client::new();
        client.weigh_by(hub.scale());
        Past { bytes: bytes.iter(), client, mailbox: Mailbox::default(), last: None, hub }
    }

    /// Handles an image. Returns whether it is due.
    fn take(&mut self, event: &Event) -> bool {
        let Event::Frame { time, image: ImageNews::Whole, .. } = event else { return false };
        let Some((_, image)) = self.client.image() else { return false };
        let total = self.client.contacts().iter().fold(0u32, |sum, p| sum.saturating_add(p.contact.total));
        let Some(line) = message::frame(&self.client, event) else {
            return false;
        };
        let shown_robot = self.hub.shown_robot();
        let pressing = shown_robot.as_ref().and_then(|shown_robot| shown_robot.pressing(&self.client, *time));
        self.mailbox.shot(&Shot {
            line: text(&PageFrame { past: Some(true), pressing, ..line }),
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
