//! What a board's filter withholds at a seam, and what presses beyond it.
//!
//! Inside a panel, the filter clamps a taxel to the greatest of its eight neighbours, so that an impulse is no
//! touch. At the edge of a panel it lacks those beyond, and withholds what a touch presses there, until it
//! lasts. The boards tell what was withheld; of that, as much is pressed as a neighbour across the seam is.

use super::file::ReadRobot;
use super::scan::BoardScan;
use super::seam_press::SeamPress;
use super::seam_taxels::{SeamTaxel, seam_taxels};
use super::touched::BoardTouch;
use std::collections::{BTreeMap, VecDeque};
use taxel_core::condition::WithheldTaxel;
use taxel_core::garment::Place;

/// Time for which a pressure beyond a seam counts, us.
const LASTS_US: u64 = 100_000;
/// Scans of the board beyond that count: a touch may have come or gone between one and the next.
const SCANS: usize = 2;

/// The edges of all boards at their seams.
#[derive(Debug, Clone)]
pub struct SeamEdges(Vec<BoardEdges>);

#[derive(Debug, Clone, Default)]
struct BoardEdges {
    /// Of a taxel at a seam: its place, and the boards and taxels that adjoin it beyond, corners included.
    taxels: BTreeMap<u16, (Place, Vec<(usize, u16)>)>,
    /// What pressed at the seams in the last scans: host time, us, and counts by taxel.
    scans: VecDeque<(u64, BTreeMap<u16, u16>)>,
}

impl SeamEdges {
    /// Of a robot; nothing is pressed yet.
    pub fn new(robot: &ReadRobot) -> SeamEdges {
        let all: Vec<Vec<SeamTaxel>> =
            (0..robot.boards.len()).map(|board| seam_taxels(robot, board)).collect();
        let mut boards = vec![BoardEdges::default(); all.len()];
        for (edges, own) in boards.iter_mut().zip(&all) {
            for taxel in own {
                let there =
                    all.iter().enumerate().flat_map(|(board, all)| all.iter().map(move |of| (board, of)));
                let beyond = there.filter(|(_, of)| of.adjoins(taxel)).map(|(board, of)| (board, of.taxel));
                // A corner may be at two seams.
                edges.taxels.entry(taxel.taxel).or_insert((taxel.place, Vec::new())).1.extend(beyond);
            }
        }
        SeamEdges(boards)
    }

    /// Notes what presses at the seams in a scan of a board, at the host's time of it, us: what its image says,
    /// or, until that comes, the most that its contacts may press there.
    pub fn note(&mut self, board: usize, scan: &BoardScan, host_us: u64) {
        let Some(edges) = self.0.get_mut(board).filter(|edges| !edges.taxels.is_empty()) else { return };
        let mut pressed = match (&scan.edge, &scan.contacts) {
            (Some(edge), _) => edge.clone(),
            (None, Some(contacts)) => edges.at_most(contacts),
            (None, None) => return,
        };
        pressed.extend(scan.withheld.iter().map(|withheld| (withheld.taxel, withheld.value)));
        edges.scans.retain(|(at, _)| *at < host_us);
        edges.scans.truncate(SCANS - 1);
        edges.scans.push_front((host_us, pressed));
    }

    /// What is pressed of what the filter of a board withheld in its scan at the host's time, us.
    pub fn pressed(&self, board: usize, withheld: &[WithheldTaxel], host_us: u64) -> Vec<SeamPress> {
        let Some(edges) = self.0.get(board) else { return Vec::new() };
        let press = |withheld: &WithheldTaxel| {
            let (place, beyond) = edges.taxels.get(&withheld.taxel)?;
            let most = beyond.iter().map(|(board, taxel)| self.most(*board, *taxel, host_us)).max()?;
            let value = withheld.value.min(most);
            let more = value.checked_sub(withheld.filtered).filter(|more| *more > 0)?;
            Some(SeamPress { taxel: withheld.taxel, place: *place, value, more })
        };
        withheld.iter().filter_map(press).collect()
    }

    /// The most that lately pressed on a taxel of a board, counts.
    fn most(&self, board: usize, taxel: u16, host_us: u64) -> u16 {
        let scans = self.0.get(board).into_iter().flat_map(|edges| &edges.scans);
        let fresh = scans.filter(|(at, _)| host_us.abs_diff(*at) <= LASTS_US);
        fresh.filter_map(|(_, pressed)| pressed.get(&taxel).copied()).max().unwrap_or(0)
    }

    /// A board is lost, or begins anew.
    pub fn forget(&mut self, board: usize) {
        if let Some(edges) = self.0.get_mut(board) {
            edges.scans.clear();
        }
    }
}

impl BoardEdges {
    /// The most that these contacts may press at the seams, counts by taxel.
    fn at_most(&self, contacts: &[BoardTouch]) -> BTreeMap<u16, u16> {
        let peak = |place: Place| {
            let here = contacts.iter().filter(|touch| touch.reaches(place, 0));
            here.map(|touch| touch.peak).max()
        };
        self.taxels.iter().filter_map(|(taxel, (place, _))| Some((*taxel, peak(*place)?))).collect()
    }
}
