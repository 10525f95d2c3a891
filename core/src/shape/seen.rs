//! The descriptor of a contact, from the taxels of an image.

use super::descriptor::{Descriptor, descriptor};
use super::patch::Patch;
use crate::capacity::TAXELS;
use crate::condition::Image;
use crate::contact::{Contact, ContactState, Slot};
use crate::garment::{Layout, Place};

/// Returns the descriptor of a contact, number `index` of those in `contacts`, from its own taxels. Of one
/// that crosses a seam, only the part on its home panel counts; of a box of more than [`TAXELS`] taxels, the
/// last rows are left out. None if there is no such panel.
#[inline(never)] // its buffer of 4 KB is on the stack only during the call
pub fn seen<const CONTACTS: usize, const RUNS: usize, const PARTS: usize, S: Slot>(
    contacts: &ContactState<CONTACTS, RUNS, PARTS, S>,
    layout: &Layout,
    image: &Image<'_>,
    (index, contact): (usize, &Contact),
) -> Option<Descriptor> {
    let bounds = &contact.bounds;
    let area = layout.areas().get(usize::from(bounds.panel))?;
    let width = usize::from(bounds.right.saturating_sub(bounds.left)) + 1;
    let (mut values, mut length) = ([0; TAXELS], 0);
    for (row, to) in (bounds.top..=bounds.bottom).zip(values.chunks_exact_mut(width)) {
        let from = image.row(area, row).iter().skip(bounds.left.into());
        for ((column, value), to) in (bounds.left..).zip(from).zip(to) {
            let place = Place { panel: bounds.panel, row, column };
            if *value > 0 && contacts.contact_at(layout, place) == Some(index) {
                *to = *value;
            }
        }
        length += width;
    }
    Some(descriptor(&Patch::new(values.get(..length).unwrap_or(&[]), width)))
}
