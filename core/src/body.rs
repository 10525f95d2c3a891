//! Where on the robot a contact is: the region of the body that its panel covers.

use crate::contact::{Contact, tenths};
use crate::format::wide;
use crate::garment::Layout;
use crate::shape::Shape;
use serde::{Deserialize, Serialize};

/// A contact with its shape and its place on the body.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Placed {
    /// The contact.
    pub contact: Contact,
    /// What shape it has.
    pub shape: Shape,
    /// Index into [`Layout::regions`].
    pub region: u8,
}

impl Placed {
    /// Places a contact that was found on a garment of this layout.
    pub fn new(layout: &Layout, contact: Contact, shape: Shape) -> Placed {
        Placed { region: region(layout, &contact), contact, shape }
    }

    /// Places another contact, or the same one in a later frame; the shape stays.
    pub(crate) fn follow(&mut self, layout: &Layout, contact: &Contact) {
        self.contact = contact.clone();
        self.region = region(layout, contact);
    }

    /// Speed over the surface in 0.1 mm/s; at 10 mm pitch where the panel gives none, with the pitch cut to
    /// 0.1 mm. Each axis is held below 2^15 taxels/s and rounded down, and the larger part counts with half
    /// of the smaller: at most 11.81 % above the true speed, and 2 steps off. At most 98,304,000, at the
    /// largest pitch.
    pub fn speed(&self, layout: &Layout) -> u32 {
        let pitch = layout.areas().get(usize::from(self.contact.panel)).map_or([0; 2], |area| area.pitch_um);
        // 31 and 13 bits.
        let along = |velocity: i32, pitch: u32| (wide(velocity.unsigned_abs(), tenths(pitch)) >> 16) as u32;
        let x = along(self.contact.vx.0, pitch[0]);
        let y = along(self.contact.vy.0, pitch[1]);
        x.max(y) + x.min(y) / 2
    }
}

fn region(layout: &Layout, contact: &Contact) -> u8 {
    layout.areas().get(usize::from(contact.panel)).map_or(0, |area| area.region)
}
