//! What the robot's contacts are made of: the contacts of a board's scan, and what is too faint for that.

use super::faint::FaintFinder;
use super::file::ReadRobot;
use super::seam_value::SeamValue;
use super::touched::BoardTouch;
use crate::client::{Client, Event, ImageNews, Worn};
use crate::files::calibrate::{Calibration, Forces};
use std::collections::BTreeMap;
use taxel_core::condition::WithheldTaxel;
use taxel_core::garment::{Place, Rect};

/// A scan of a board.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BoardScan {
    /// Its contacts; none if they were not told with it.
    pub contacts: Option<Vec<BoardTouch>>,
    /// What touches a seam to another board and is too faint to be a contact; none if there is no image.
    pub faint: Option<Vec<BoardTouch>>,
    /// What presses along the seams to other boards, by taxel; none if there is no image.
    pub edge: Option<BTreeMap<u16, SeamValue>>,
    /// What the filter withholds of it at the edges of panels.
    pub withheld: Vec<WithheldTaxel>,
}

/// Reads the scans of a board from its events.
#[derive(Debug, Clone, Default)]
pub struct ScanReader {
    finder: FaintFinder,
    /// The board's calibration, and the curves of its panels.
    calibration: Option<(Calibration, Forces)>,
}

impl ScanReader {
    /// Of a board of a robot.
    pub fn new(robot: &ReadRobot, board: usize) -> ScanReader {
        let worn = robot.boards.get(board).and_then(|of| of.garment.as_ref().zip(of.calibration.clone()));
        let calibration = worn.and_then(|(worn, calibration)| {
            Forces::new(&calibration, &worn.layout).ok().map(|f| (calibration, f))
        });
        ScanReader { finder: FaintFinder::new(robot, board), calibration }
    }

    /// The scan of an event, which the client already includes; none if the event is not about a scan.
    pub fn scan(&self, client: &Client, event: &Event) -> Option<BoardScan> {
        match event {
            Event::Contacts { frame, .. } => {
                let told = client.contacts().iter().map(|placed| BoardTouch::from(&placed.contact)).collect();
                let (contacts, withheld) =
                    (Some(self.weighed(client, told)), client.withheld(*frame).to_vec());
                Some(BoardScan { contacts, withheld, ..BoardScan::default() })
            }
            Event::Frame { image: ImageNews::Whole, frame, .. } => {
                let faint = self.finder.find(client).map(|found| self.weighed(client, found));
                let withheld = client.withheld(*frame).to_vec();
                let edge = self.finder.edge(client, &withheld);
                Some(BoardScan { contacts: None, faint, edge, withheld })
            }
            Event::Frame { .. } => Some(BoardScan::default()),
            _ => None,
        }
    }

    /// The same touches with their newtons per count in the last image, if a calibration is in force.
    fn weighed(&self, client: &Client, mut touches: Vec<BoardTouch>) -> Vec<BoardTouch> {
        let Some((calibration, forces)) = &self.calibration else { return touches };
        let (Some(worn), Some((_, image))) = (client.worn(), client.image()) else { return touches };
        if calibration.is_in_force(&worn.calibration) {
            for touch in &mut touches {
                touch.newtons_per_count = newtons_per_count(forces, worn, image, &touch.bounds);
            }
        }
        touches
    }
}

/// Force within the box of a touch and around it by the pressure of its taxels, N per count.
fn newtons_per_count(forces: &Forces, worn: &Worn, image: &[u16], bounds: &Rect) -> Option<f64> {
    let newtons = forces.contact(&worn.layout, image, bounds)?;
    let places = (bounds.top..=bounds.bottom).flat_map(|row| {
        (bounds.left..=bounds.right).map(move |column| Place { panel: bounds.panel, row, column })
    });
    let values = places.filter_map(|place| image.get(worn.layout.taxel(place)?).copied());
    let counts: u32 = values.filter(|value| *value >= worn.scene.contact.low).map(u32::from).sum();
    (counts > 0).then(|| newtons / f64::from(counts))
}
