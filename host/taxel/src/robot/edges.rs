//! What the filters of boards leave at their seams, less or more than one filter over both panels would.
//!
//! Inside a panel, the filter clamps a taxel that stands out from its eight neighbours, so that an impulse is no
//! touch, and restores it if it did so in the previous scan, too. At the edge of a panel it lacks the neighbours
//! beyond: it withholds what a touch presses there, and restores what does not stand out from them. What the
//! boards tell of their edges is judged anew, with the neighbours beyond as they were at the time of the scan.

use super::file::ReadRobot;
use super::scan::BoardScan;
use super::seam_change::SeamChange;
use super::seam_taxels::{SeamTaxel, seam_taxels};
use super::seam_value::SeamValue;
use super::touched::BoardTouch;
use std::collections::{BTreeMap, VecDeque};
use taxel_core::condition::WithheldTaxel;
use taxel_core::garment::Place;

/// Time for which a pressure beyond a seam counts, us.
const LASTS_US: u64 = 100_000;

/// The edges of all boards at their seams.
#[derive(Debug, Clone)]
pub struct SeamEdges(Vec<BoardEdges>);

#[derive(Debug, Clone, Default)]
struct BoardEdges {
    /// Of a taxel at a seam: its place, and the boards and taxels that adjoin it beyond, corners included.
    taxels: BTreeMap<u16, (Place, Vec<(usize, u16)>)>,
    /// The boards beyond.
    beyond: Vec<usize>,
    /// The last scans, the newest last.
    scans: VecDeque<EdgeScan>,
}

/// The edges of a board in a scan.
#[derive(Debug, Clone)]
struct EdgeScan {
    /// The host's time of it, us.
    host_us: u64,
    /// There was an image of it: of what is not among `taxels`, nothing presses.
    is_whole: bool,
    /// What is told of its own taxels.
    taxels: BTreeMap<u16, SeamValue>,
    /// The least and the most that may press at the seams, for those beyond, counts by taxel.
    pressed: BTreeMap<u16, [u16; 2]>,
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
            edges.beyond =
                edges.taxels.values().flat_map(|(_, beyond)| beyond.iter().map(|(b, _)| *b)).collect();
            edges.beyond.sort_unstable();
            edges.beyond.dedup();
        }
        SeamEdges(boards)
    }

    /// Notes what presses at the seams in a scan of a board, at the host's time of it, us: what its image says,
    /// or, until that comes, what that of the scan before said. Without images it is the most that the contacts
    /// may press there.
    pub fn note(&mut self, board: usize, scan: &BoardScan, host_us: u64) {
        let Some(edges) = self.0.get_mut(board).filter(|edges| !edges.taxels.is_empty()) else { return };
        let is_told = |last: &EdgeScan| last.host_us == host_us && last.is_whole;
        if scan.edge.is_none() && edges.scans.back().is_some_and(is_told) {
            return;
        }
        edges.scans.retain(|old| old.host_us < host_us && host_us - old.host_us <= 2 * LASTS_US);
        let noted = match (&scan.edge, &scan.contacts) {
            (Some(edge), _) => EdgeScan {
                host_us,
                is_whole: true,
                taxels: edge.clone(),
                pressed: edge.iter().map(|(taxel, of)| (*taxel, of.range())).collect(),
            },
            (None, Some(contacts)) => edges.without_image(host_us, contacts, &scan.withheld),
            (None, None) => return,
        };
        edges.scans.push_back(noted);
    }

    /// A board, and those beyond its seams.
    pub fn beside(&self, board: usize) -> impl Iterator<Item = usize> {
        let beyond = self.0.get(board).into_iter().flat_map(|edges| &edges.beyond);
        beyond.copied().chain([board])
    }

    /// The scans of a board of which others may have told more since, and the changes in them.
    pub fn changes(&self, board: usize) -> impl Iterator<Item = (u64, Vec<SeamChange>)> {
        let edges = self.0.get(board).filter(|edges| !edges.taxels.is_empty());
        let last_but_one = |board: &usize| self.0.get(*board)?.scans.iter().rev().nth(1);
        let beyond = edges.into_iter().flat_map(|edges| &edges.beyond);
        let since = beyond.filter_map(last_but_one).map(|scan| scan.host_us).min().unwrap_or(0);
        let scans = edges.into_iter().flat_map(|edges| edges.scans.iter().map(move |scan| (edges, scan)));
        let open = scans.skip_while(move |(_, scan)| scan.host_us <= since);
        open.map(|(edges, scan)| (scan.host_us, self.changes_in(edges, scan)))
    }

    /// What one filter over all panels would have changed in a scan.
    fn changes_in(&self, edges: &BoardEdges, scan: &EdgeScan) -> Vec<SeamChange> {
        let before = edges.scans.iter().rev().find(|before| before.host_us < scan.host_us);
        let before = before.filter(|before| scan.host_us - before.host_us <= LASTS_US);
        let change = |(taxel, now): (&u16, &SeamValue)| {
            let (place, beyond) = edges.taxels.get(taxel)?;
            let [least, most] = self.around(beyond, scan.host_us);
            let [before_least, _] = before.map_or([0; 2], |before| self.around(beyond, before.host_us));
            if least == 0 && before_least == 0 {
                return None;
            }
            let was = before.and_then(|before| before.taxels.get(taxel));
            let lasting = was.and_then(|was| was.stood_out(before_least));
            let value = now.filtered_by_all(least, lasting);
            // No less is taken than what its board surely restored, which a scan without an image does not say.
            let is_known = before.is_some_and(|before| before.is_whole);
            let surely = if is_known { now.filtered_by_all(most, lasting).min(now.told) } else { now.told };
            let value = value.max(surely);
            (value != now.told).then_some(SeamChange { taxel: *taxel, place: *place, told: now.told, value })
        };
        scan.taxels.iter().filter_map(change).collect()
    }

    /// The greatest of what pressed on some taxels of boards at a time of the host, us: at least, at most.
    fn around(&self, taxels: &[(usize, u16)], host_us: u64) -> [u16; 2] {
        let ranges = taxels.iter().map(|(board, taxel)| self.at(*board, *taxel, host_us));
        ranges.fold([0; 2], |[least, most], [a, b]| [least.max(a), most.max(b)])
    }

    /// What pressed on a taxel of a board at a time of the host, us, at least and at most: interpolated between
    /// two of its scans; before the first and after the last, what that one says, if it is near.
    fn at(&self, board: usize, taxel: u16, host_us: u64) -> [u16; 2] {
        let Some(BoardEdges { scans, .. }) = self.0.get(board) else { return [0; 2] };
        let after = scans.partition_point(|scan| scan.host_us <= host_us);
        let near = |scan: &&EdgeScan| scan.host_us.abs_diff(host_us) <= LASTS_US;
        let of = |scan: &EdgeScan| scan.pressed.get(&taxel).copied().unwrap_or([0; 2]);
        let before = after.checked_sub(1).and_then(|before| scans.get(before)).filter(near);
        match (before, scans.get(after).filter(near)) {
            (Some(a), Some(b)) => {
                let part = (host_us - a.host_us) as f64 / (b.host_us - a.host_us) as f64;
                let between = |[from, to]: [u16; 2]| {
                    (f64::from(from) + (f64::from(to) - f64::from(from)) * part).round() as u16
                };
                let ([least, most], [later_least, later_most]) = (of(a), of(b));
                [between([least, later_least]), between([most, later_most])]
            }
            (Some(scan), None) | (None, Some(scan)) => of(scan),
            (None, None) => [0; 2],
        }
    }

    /// A board is lost, or begins anew.
    pub fn forget(&mut self, board: usize) {
        if let Some(edges) = self.0.get_mut(board) {
            edges.scans.clear();
        }
    }
}

impl BoardEdges {
    /// A scan of which there is no image, or not yet.
    fn without_image(&self, host_us: u64, contacts: &[BoardTouch], withheld: &[WithheldTaxel]) -> EdgeScan {
        let taxels = withheld.iter().map(|of| (of.taxel, SeamValue::from(of))).collect();
        let mut pressed = match self.scans.back().filter(|last| last.is_whole) {
            Some(last) => last.pressed.clone(),
            None => self.at_most(contacts),
        };
        pressed.extend(withheld.iter().map(|withheld| (withheld.taxel, [withheld.value; 2])));
        EdgeScan { host_us, is_whole: false, taxels, pressed }
    }

    /// The most that these contacts may press at the seams, counts by taxel.
    fn at_most(&self, contacts: &[BoardTouch]) -> BTreeMap<u16, [u16; 2]> {
        let peak = |place: Place| {
            let here = contacts.iter().filter(|touch| touch.reaches(place, 0));
            here.map(|touch| touch.peak).max()
        };
        self.taxels.iter().filter_map(|(taxel, (place, _))| Some((*taxel, [peak(*place)?; 2]))).collect()
    }
}
