//! A contact of a board, with its force if newtons are known.

use crate::client::{Client, Event};
use taxel_core::body::Placed;
use taxel_core::garment::Rect;

/// A contact of a board.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardContact {
    /// Id on the board.
    pub id: u32,
    /// Index of the panel.
    pub panel: u8,
    /// Sum of the pressure, counts.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// Number of taxels.
    pub area: u16,
    /// Box of its taxels on the panel.
    pub bounds: Rect,
    /// Centroid, `[x, y]` in taxels of the panel.
    pub centroid: [f64; 2],
    /// Velocity of the centroid, taxels per second.
    pub velocity: [f64; 2],
    /// Newtons per count of the total; none if they are unknown.
    pub newtons_per_count: Option<f64>,
}

impl BoardContact {
    /// A present contact of a client.
    pub fn of(client: &Client, placed: &Placed) -> BoardContact {
        let contact = &placed.contact;
        let image = client.image().map_or(&[][..], |(_, image)| image);
        let newtons = client.newtons().zip(client.description()).and_then(|(newtons, description)| {
            let low = description.scene.contact.low;
            newtons.per_count(&description.layout, image, low, &contact.bounds)
        });
        BoardContact {
            id: contact.id,
            panel: contact.panel,
            total: contact.total,
            peak: contact.peak,
            area: contact.area,
            bounds: contact.bounds,
            centroid: [contact.x, contact.y].map(|place| place.to_f64()),
            velocity: [contact.vx, contact.vy].map(|speed| speed.to_f64()),
            newtons_per_count: newtons,
        }
    }

    /// Present contacts of a list, which the client already includes; none if the event is no list of contacts.
    pub fn all(client: &Client, event: &Event) -> Option<Vec<BoardContact>> {
        let is_list = matches!(event, Event::Contacts { .. });
        is_list.then(|| client.contacts().iter().map(|placed| BoardContact::of(client, placed)).collect())
    }
}
