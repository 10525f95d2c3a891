//! The table of contacts: one entry each, with what later stages keep beside a contact.

use crate::measure::contact::Contact;

/// An entry of the table. It begins with a new contact, and stays with it until the release.
pub trait Slot: From<Contact> + Clone {
    /// The contact.
    fn contact(&self) -> &Contact;

    /// The contact, to be updated.
    fn contact_mut(&mut self) -> &mut Contact;
}

impl Slot for Contact {
    #[inline(always)]
    fn contact(&self) -> &Contact {
        self
    }

    #[inline(always)]
    fn contact_mut(&mut self) -> &mut Contact {
        self
    }
}
