//! The taxels of a board along its seams to other boards.

use super::file::ReadRobot;
use taxel_core::garment::Place;

/// A taxel at a seam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeamTaxel {
    /// Its number on its board.
    pub taxel: u16,
    /// Where that is.
    pub place: Place,
    /// Number of the seam, which of its edges, and how far along it, taxels.
    seam: usize,
    edge: usize,
    along: u16,
}

impl SeamTaxel {
    /// True if the two lie across their seam from each other, corners included.
    pub fn adjoins(&self, other: &SeamTaxel) -> bool {
        self.seam == other.seam && self.edge != other.edge && self.along.abs_diff(other.along) <= 1
    }
}

/// All of them, seam by seam; none if the board's garment is unknown.
pub fn seam_taxels(robot: &ReadRobot, board: usize) -> Vec<SeamTaxel> {
    let Some(worn) = robot.boards.get(board).and_then(|board| board.garment.as_ref()) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for (number, seam) in robot.seams.iter().enumerate() {
        for (edge, side) in [seam.a, seam.b].into_iter().enumerate().filter(|(_, side)| side.board == board) {
            let is_turned = seam.reversed && edge == 1;
            for (at, place) in (0..).zip(side.places(&worn.layout, seam.length)) {
                let along = if is_turned { seam.length - 1 - at } else { at };
                let taxel = worn.layout.taxel(place).and_then(|taxel| u16::try_from(taxel).ok());
                found.extend(taxel.map(|taxel| SeamTaxel { taxel, place, seam: number, edge, along }));
            }
        }
    }
    found
}
