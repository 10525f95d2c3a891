//! Growth of the present contacts, and the hardness derived from it.

use std::collections::BTreeMap;
use taxel_core::body::Placed;
use taxel_core::contact::HardnessCue;
use taxel_core::garment::Layout;

/// Growth and last panel by contact id.
#[derive(Debug, Default, Clone)]
pub struct Growths(BTreeMap<u32, (HardnessCue, u8)>);

impl Growths {
    /// Handles a frame. Contacts just released stay known until the next frame.
    pub fn feel(&mut self, present: &[Placed], gone: &[Placed]) {
        let id = |placed: &Placed| placed.contact.id;
        self.0.retain(|known, _| present.iter().chain(gone).any(|placed| id(placed) == *known));
        for placed in present {
            let (growth, panel) = self.0.entry(id(placed)).or_default();
            growth.feel(placed.contact.total, placed.contact.area);
            *panel = placed.contact.panel;
        }
    }

    /// Apparent hardness of a contact, counts per cm2; none if unknown.
    pub fn hardness(&self, contact: u32, layout: &Layout) -> Option<u32> {
        let (growth, panel) = self.0.get(&contact)?;
        growth.hardness(layout.areas().get(usize::from(*panel))?.cell_mm2)
    }

    /// Greatest force of a contact since its onset, counts; none if the contact is unknown.
    pub fn greatest_force(&self, contact: u32) -> Option<u32> {
        self.0.get(&contact).map(|(growth, _)| growth.greatest_force())
    }
}
