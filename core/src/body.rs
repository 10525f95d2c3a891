//! Place of a contact on the robot: the region of the body that its panel covers.

use crate::contact::{Contact, Slot, tenths};
use crate::format::wide;
use crate::garment::Layout;
use crate::shape::Shape;
use serde::{Deserialize, Serialize};

/// A contact with its shape and its place on the body.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Placed {
    /// The contact.
    pub contact: Contact,
    /// Shape of the contact.
    pub shape: Shape,
    /// Index into [`Layout::regions`].
    pub region: u8,
}

impl Placed {
    /// Places a contact that was found on a garment of this layout.
    pub fn new(layout: &Layout, contact: Contact, shape: Shape) -> Placed {
        Placed { region: region(layout, &contact), contact, shape }
    }

    /// Sets the region, after the contact has come to another panel.
    pub(crate) fn place(&mut self, layout: &Layout) {
        self.region = region(layout, &self.contact);
    }

    /// Displacement since the onset along x and y, 0.1 mm, rounded down. The pitch is taken as in
    /// [`Placed::speed`].
    pub fn way(&self, layout: &Layout) -> [i32; 2] {
        let pitch = layout.areas().get(usize::from(self.contact.panel)).map_or([0; 2], |area| area.pitch_um);
        let Contact { dx, dy, .. } = self.contact;
        let along = |way: i32, pitch: u32| {
            let size = (wide(way.unsigned_abs(), tenths(pitch)) >> 16) as i32; // 32 and 13 bits
            if way < 0 { -size } else { size }
        };
        [along(dx.0, pitch[0]), along(dy.0, pitch[1])]
    }

    /// Speed over the surface, 0.1 mm/s. The pitch is truncated to 0.1 mm; it is 10 mm for panels that give
    /// none. Each axis is limited to below 2^15 taxels/s and rounded down. The larger axis plus half of the
    /// smaller: at most 11.81 % above the true speed, and 2 steps off. At most 98,304,000, at the largest
    /// pitch.
    pub fn speed(&self, layout: &Layout) -> u32 {
        let pitch = layout.areas().get(usize::from(self.contact.panel)).map_or([0; 2], |area| area.pitch_um);
        // 31 and 13 bits.
        let along = |velocity: i32, pitch: u32| (wide(velocity.unsigned_abs(), tenths(pitch)) >> 16) as u32;
        let x = along(self.contact.vx.0, pitch[0]);
        let y = along(self.contact.vy.0, pitch[1]);
        x.max(y) + x.min(y) / 2
    }
}

/// The entry of a new contact: without a shape, and not placed yet.
impl From<Contact> for Placed {
    fn from(contact: Contact) -> Placed {
        Placed { contact, shape: Shape::default(), region: 0 }
    }
}

impl Slot for Placed {
    #[inline(always)]
    fn contact(&self) -> &Contact {
        &self.contact
    }

    #[inline(always)]
    fn contact_mut(&mut self) -> &mut Contact {
        &mut self.contact
    }
}

fn region(layout: &Layout, contact: &Contact) -> u8 {
    layout.areas().get(usize::from(contact.panel)).map_or(0, |area| area.region)
}
