//! How the contacts that are there have grown, and how hard they seem by that.

use std::collections::BTreeMap;
use taxel_core::body::Placed;
use taxel_core::contact::HardnessCue;
use taxel_core::garment::Layout;

/// By the contact's id, with the panel that it was on last.
#[derive(Debug, Default, Clone)]
pub struct Growths(BTreeMap<u32, (HardnessCue, u8)>);

impl Growths {
    /// Takes a frame: those that are there, and those that have just gone, which are known until the next.
    pub fn feel(&mut self, present: &[Placed], gone: &[Placed]) {
        let id = |placed: &Placed| placed.contact.id;
        self.0.retain(|known, _| present.iter().chain(gone).any(|placed| id(placed) == *known));
        for placed in present {
            let (growth, panel) = self.0.entry(id(placed)).or_default();
            growth.feel(placed.contact.total, placed.contact.area);
            *panel = placed.contact.panel;
        }
    }

    /// How hard a contact seems, counts per cm2; none where that is not known.
    pub fn hardness(&self, contact: u32, layout: &Layout) -> Option<u32> {
        let (growth, panel) = self.0.get(&contact)?;
        growth.hardness(layout.areas().get(usize::from(*panel))?.cell_mm2)
    }
}
