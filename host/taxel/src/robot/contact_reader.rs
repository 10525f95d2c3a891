//! Reads the contacts of a board from its events, with their forces.

use super::board::RobotBoard;
use super::contact::BoardContact;
use crate::client::{BoardDescription, Client, Event};
use crate::files::calibrate::{Calibration, Forces};
use taxel_core::garment::{Place, Rect};

/// Reads the contacts of a board from its events.
#[derive(Debug, Clone, Default)]
pub struct ContactReader {
    /// The board's calibration, and the curves of its panels.
    calibration: Option<(Calibration, Forces)>,
}

impl ContactReader {
    /// Makes the reader of a board of a robot.
    pub fn new(board: &RobotBoard) -> ContactReader {
        let description = board.garment.as_ref().zip(board.calibration.clone());
        let calibration = description.and_then(|(description, calibration)| {
            Forces::new(&calibration, &description.layout).ok().map(|f| (calibration, f))
        });
        ContactReader { calibration }
    }

    /// Present contacts of a list, which the client already includes; none if the event is no list of contacts.
    pub fn contacts(&self, client: &Client, event: &Event) -> Option<Vec<BoardContact>> {
        let is_list = matches!(event, Event::Contacts { .. });
        is_list.then(|| {
            let contacts = client.contacts().iter().map(|placed| BoardContact::from(&placed.contact));
            self.weighed(client, contacts.collect())
        })
    }

    /// Adds the newtons per count in the last image, if the calibration is in force.
    fn weighed(&self, client: &Client, mut contacts: Vec<BoardContact>) -> Vec<BoardContact> {
        let Some((calibration, forces)) = &self.calibration else { return contacts };
        let (Some(description), Some((_, image))) = (client.description(), client.image()) else {
            return contacts;
        };
        if calibration.is_in_force(&description.calibration) {
            for contact in &mut contacts {
                contact.newtons_per_count = newtons_per_count(forces, description, image, &contact.bounds);
            }
        }
        contacts
    }
}

/// Force within the box of a contact and around it by the pressure of its taxels, N per count.
fn newtons_per_count(
    forces: &Forces,
    description: &BoardDescription,
    image: &[u16],
    bounds: &Rect,
) -> Option<f64> {
    let newtons = forces.contact(&description.layout, image, bounds)?;
    let places = (bounds.top..=bounds.bottom).flat_map(|row| {
        (bounds.left..=bounds.right).map(move |column| Place { panel: bounds.panel, row, column })
    });
    let values = places.filter_map(|place| image.get(description.layout.taxel(place)?).copied());
    let counts: u32 = values.filter(|value| *value >= description.scene.contact.low).map(u32::from).sum();
    (counts > 0).then(|| newtons / f64::from(counts))
}
