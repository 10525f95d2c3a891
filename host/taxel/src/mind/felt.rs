//! Touches that a board reports, for the mind of its robot.

use super::mover::SurfaceSpot;
use super::place::{BoardPlaces, BodyPlace};
use crate::client::{Client, Event};
use crate::fcm::map::MapFile;
use crate::robot::{BoardContact, ReadRobot, RobotBoard};
use std::sync::Arc;
use taxel_core::garment::cell_mm2;
use taxel_core::wire::IntentReport;

/// A contact of a board, and where on the body it lies.
#[derive(Debug, Clone, PartialEq)]
pub struct FeltContact {
    /// Id of the board's contact.
    pub contact: u32,
    /// Place on the body.
    pub place: Arc<BodyPlace>,
    /// The point of the robot's surface; none unless the board has a body.
    pub spot: Option<SurfaceSpot>,
    /// Force, thousandths of a newton; pressure, counts, if newtons are unknown.
    pub load: u32,
    /// Area, mm2.
    pub cover_mm2: u32,
    /// Greatest pressure on a taxel, in the unit of the load.
    pub peak: u32,
    /// Number of the panel.
    pub panel: u8,
    /// Centroid on the panel along columns and rows, mm.
    pub at_mm: [f64; 2],
}

/// The garment of a board, as far as the mind needs it.
#[derive(Debug, Clone)]
pub struct BoardPlacement {
    /// All places of the body that its garment covers.
    pub places: Vec<Arc<BodyPlace>>,
    /// The map of its scene; none if it has none.
    pub map: Option<Arc<MapFile>>,
}

/// Content of a board's event about touches.
#[derive(Debug, Clone)]
pub enum BoardSense {
    /// Start of the board, or another garment or scene of it.
    Begins(BoardPlacement),
    /// Contacts of the board.
    Contacts(Vec<FeltContact>),
    /// Intention of the board.
    Intent(Box<IntentReport>),
    /// Sign that it scans.
    Alive,
}

/// Reads a board's events for the mind of its robot, in the board's thread.
#[derive(Debug, Clone)]
pub struct MindReader {
    board: RobotBoard,
    places: BoardPlaces,
}

impl MindReader {
    /// Makes the reader of a board of a robot.
    pub fn new(robot: &ReadRobot, board: usize) -> MindReader {
        let board = robot.boards[board].clone();
        MindReader { board, places: BoardPlaces::default() }
    }

    /// Returns what an event says, which the client already includes; none if it says nothing of touches.
    pub fn sense(&mut self, client: &Client, event: &Event) -> Option<BoardSense> {
        match event {
            Event::Hello => Some(BoardSense::Begins(self.begin(client)?)),
            Event::Intent(report) => Some(BoardSense::Intent(report.clone())),
            Event::Frame { .. } => Some(BoardSense::Alive),
            _ => {
                let contacts = BoardContact::all(client, event)?;
                let felt = contacts.iter().filter_map(|contact| self.felt(client, contact));
                Some(BoardSense::Contacts(felt.collect()))
            }
        }
    }

    fn begin(&mut self, client: &Client) -> Option<BoardPlacement> {
        let description = client.description()?;
        self.places = BoardPlaces::of(&self.board, description);
        let map = description.scene.intent.as_ref().map(|intent| Arc::new(MapFile::from_config(&intent.map)));
        Some(BoardPlacement { places: self.places.all(), map })
    }

    fn felt(&self, client: &Client, contact: &BoardContact) -> Option<FeltContact> {
        let description = client.description()?;
        let pitch_um = description.layout.areas().get(usize::from(contact.panel))?.pitch_um;
        // A pitch that is not known is taken as 10 mm.
        let [x_mm, y_mm] = pitch_um.map(|um| if um == 0 { 10.0 } else { f64::from(um) * 1e-3 });
        let scaled = |counts: u32| match contact.newtons_per_count {
            Some(newtons) => (newtons * f64::from(counts) * 1e3).round() as u32,
            None => counts,
        };
        let (place, spot) = self.places.at(description, contact.panel, contact.centroid)?;
        Some(FeltContact {
            contact: contact.id,
            place,
            spot,
            load: scaled(contact.total),
            cover_mm2: u32::from(contact.area).saturating_mul(cell_mm2(pitch_um)),
            peak: scaled(contact.peak.into()),
            panel: contact.panel,
            at_mm: [contact.centroid[0] * x_mm, contact.centroid[1] * y_mm],
        })
    }
}
