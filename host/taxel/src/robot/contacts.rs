//! Contacts of all boards: what touches both sides of a seam between boards is one contact with one id.
//!
//! Boards scan at times of their own. Whenever a list of a board arrives, the newest contacts of the others
//! are carried on to its time by their velocities, by one scan of theirs at most. Two contacts of
//! neighbouring panels are joined if the boxes around them then meet at the seam; they stay joined until more
//! than a taxel lies between them. The oldest of the ids that are joined goes on. If a contact comes apart,
//! the greater part keeps the id.
//!
//! What meets a contact at a seam and is too faint to be one on its own board belongs to it: it is found in
//! the board's image ([`ScanReader`](super::ScanReader)).
//!
//! Pressure and place of a contact on several boards are told from the newest scan of each, until the newest
//! time that all of them have told; there the parts on the others are interpolated between their scans. The
//! contact's time is the mean of these times.
//!
//! A contact that ends at a seam is not over yet: for [`CROSSING_US`], and twice the time between the scans
//! of the board across, a contact that begins there, where it would be by its velocity, continues it.

use super::carried::CarriedTouch;
use super::contact::RobotContact;
use super::edges::SeamEdges;
use super::file::ReadRobot;
use super::joined::{JoinedTouches, STAYS, is_at, meet};
use super::listed::{ListedBoard, ListedTouch};
use super::plane::SeamPlane;
use super::scan::BoardScan;
use super::touch::RobotTouchPart;
use std::collections::{BTreeMap, BTreeSet};
use taxel_core::contact::Phase;

/// Wait for a contact to go on across a seam, us, besides twice the time between scans.
pub const CROSSING_US: u64 = 30_000;
/// Distance from a seam within which a contact that ends may go on beyond it, mm: the gate within which a
/// board looks for its own contacts.
const GATE_MM: f64 = 40.0;

/// Joins the contacts of all boards.
#[derive(Debug, Clone)]
pub struct RobotContacts {
    planes: Vec<SeamPlane>,
    boards: Vec<ListedBoard>,
    edges: SeamEdges,
    present: BTreeMap<u32, PresentContact>,
    ids: u32,
}

#[derive(Debug, Clone)]
struct PresentContact {
    shown: RobotContact,
    /// Its last part, which ended at a seam, and the host's time until which it may go on beyond.
    waits: Option<(CarriedTouch, u64)>,
}

impl RobotContacts {
    /// No contacts yet.
    pub fn new(robot: &ReadRobot) -> RobotContacts {
        let planes = robot.seams.iter().filter_map(|seam| SeamPlane::of(seam, &robot.boards)).collect();
        let boards = (0..robot.boards.len()).map(ListedBoard::new).collect();
        let edges = SeamEdges::new(robot);
        RobotContacts { planes, boards, edges, present: BTreeMap::new(), ids: 0 }
    }

    /// Takes a scan of a board, which began at the host's time, us. Returns the robot's contacts then, and
    /// those just released, by their ids; nothing if nothing touches, or nothing has changed.
    pub fn scan(&mut self, board: usize, scan: &BoardScan, host_us: u64) -> Vec<RobotContact> {
        let Some(listed) = self.boards.get_mut(board) else { return Vec::new() };
        listed.scanned(host_us);
        self.edges.note(board, scan, host_us);
        if let Some(faint) = &scan.faint {
            listed.image(faint, host_us);
        }
        match &scan.contacts {
            Some(contacts) => {
                let gone = listed.list(contacts, host_us);
                gone.iter().for_each(|old| self.wait(old, host_us));
                for beside in self.edges.beside(board) {
                    let listed = self.boards.get_mut(beside);
                    listed.into_iter().for_each(|listed| listed.change(&self.edges));
                }
                self.join(host_us)
            }
            None => self.pass(host_us),
        }
    }

    /// A board has scanned without a list. Returns the contacts that have waited in vain and are released,
    /// and the present ones with them.
    fn pass(&mut self, host_us: u64) -> Vec<RobotContact> {
        let is_due =
            |present: &PresentContact| present.waits.as_ref().is_some_and(|(_, until)| *until <= host_us);
        match self.present.values().any(is_due) {
            true => self.join(host_us),
            false => Vec::new(),
        }
    }

    /// A board is lost, or begins anew: its contacts are over.
    pub fn forget(&mut self, board: usize, host_us: u64) -> Vec<RobotContact> {
        if let Some(listed) = self.boards.get_mut(board) {
            *listed = ListedBoard::new(board);
            self.edges.forget(board);
        }
        self.join(host_us)
    }

    /// Lets the contact of a part that has ended wait, if it was its last one and is near a seam.
    fn wait(&mut self, old: &ListedTouch, host_us: u64) {
        let Some(id) = old.id else { return };
        let mut listed = self.boards.iter().flat_map(ListedBoard::touches);
        if listed.any(|listed| listed.id == Some(id) && listed.is_contact()) {
            return;
        }
        let across = |plane: &SeamPlane, at: usize| {
            let (here, there) = (&plane.sides[at], &plane.sides[1 - at]);
            let is_near = is_at(&old.carried, here)
                && old.carried.bounds(here, host_us).away <= GATE_MM
                && old.carried.bounds(here, host_us).is_along(plane.length, STAYS);
            is_near.then(|| self.boards[there.edge.board].interval_us())
        };
        let beside = self.planes.iter().flat_map(|plane| [across(plane, 0), across(plane, 1)]);
        let Some(interval_us) = beside.flatten().max() else { return };
        let patience_us = CROSSING_US + 2 * interval_us.max(old.carried.interval_us());
        if let Some(present) = self.present.get_mut(&id) {
            present.waits =
                Some((old.carried.clone().lasting(patience_us), host_us.saturating_add(patience_us)));
        }
    }

    /// Joins what meets, and gives each group its id.
    fn join(&mut self, host_us: u64) -> Vec<RobotContact> {
        // What has ended counts until all boards have told of that time.
        let slowest_us = self.boards.iter().map(ListedBoard::interval_us).max().unwrap_or(0);
        self.boards.iter_mut().for_each(|board| board.forget_ended(host_us, slowest_us));
        let joined = JoinedTouches::new(&self.planes, &self.boards, host_us);
        let joined_contacts = joined.contacts();
        let mut ids = self.ids_that_go_on(&joined, &joined_contacts, host_us);
        let mut shown = Vec::new();
        for (group, members) in &joined_contacts {
            let id = *ids.entry(*group).or_insert_with(|| {
                self.ids += 1;
                self.ids
            });
            let before = self.present.get(&id).map(|present| present.shown.onset_us);
            let contact = RobotContact {
                id,
                phase: before.map_or(Phase::Onset, |_| Phase::Held),
                onset_us: before.unwrap_or(host_us),
                touch: joined.touch(members),
            };
            shown.push(contact.clone());
            self.present.insert(id, PresentContact { shown: contact, waits: None });
        }
        let groups = joined.groups;
        let listed = self.boards.iter_mut().flat_map(ListedBoard::touches_mut);
        for (listed, group) in listed.zip(&groups) {
            listed.id = ids.get(group).copied().or(listed.id);
        }
        shown.extend(self.end(&ids, host_us));
        shown.sort_by_key(|contact| contact.id);
        shown
    }

    /// The ids of groups that are present already, by the group.
    fn ids_that_go_on(
        &self,
        joined: &JoinedTouches<'_>,
        joined_contacts: &BTreeMap<usize, Vec<usize>>,
        host_us: u64,
    ) -> BTreeMap<usize, u32> {
        let contacts = || joined.all.iter().zip(&joined.groups).filter(|(listed, _)| listed.is_contact());
        // Of an id that has come apart, the greater part keeps it.
        let mut keeps: BTreeMap<u32, (f64, usize)> = BTreeMap::new();
        for (listed, group) in joined.all.iter().zip(&joined.groups) {
            let goes_on = |id: &u32| joined_contacts.contains_key(group) && self.present.contains_key(id);
            let Some(id) = listed.id.filter(goes_on) else { continue };
            let total = listed.carried.total(host_us);
            let kept = keeps.entry(id).or_insert((total, *group));
            if total > kept.0 {
                *kept = (total, *group);
            }
        }
        let mut ids: BTreeMap<usize, u32> = BTreeMap::new();
        for (id, (_, group)) in keeps {
            // In the order of ids: the oldest goes on.
            ids.entry(group).or_insert(id);
        }
        for (listed, group) in contacts() {
            if !ids.contains_key(group)
                && let Some(id) = self.waiting_for(&listed.carried, host_us)
            {
                ids.insert(*group, id);
            }
        }
        ids
    }

    /// Id of a contact that waits at a seam, and that this one continues: the oldest.
    fn waiting_for(&self, new: &CarriedTouch, host_us: u64) -> Option<u32> {
        let continues = |(old, _): &(CarriedTouch, u64)| {
            self.planes.iter().any(|plane| {
                let [a, b] = &plane.sides;
                [(a, b), (b, a)].into_iter().any(|(here, there)| {
                    let is_there = is_at(old, here) && is_at(new, there);
                    is_there && meet(plane, &old.bounds(here, host_us), &new.bounds(there, host_us), STAYS)
                })
            })
        };
        let waiting =
            self.present.iter().filter(|(_, present)| present.waits.as_ref().is_some_and(continues));
        waiting.map(|(id, _)| *id).next()
    }

    /// What is there no longer: it waits, or is released.
    fn end(&mut self, ids: &BTreeMap<usize, u32>, host_us: u64) -> Vec<RobotContact> {
        let mut gone = Vec::new();
        let there: BTreeSet<u32> = ids.values().copied().collect();
        self.present.retain(|id, present| {
            if there.contains(id) {
                return true;
            }
            let waits = present.waits.as_ref().filter(|(_, until)| host_us < *until);
            present.shown.phase = if waits.is_some() { Phase::Held } else { Phase::Released };
            let touch = &mut present.shown.touch;
            let total = waits.map_or(0.0, |(carried, _)| carried.total(host_us));
            touch.total = total.round() as u32;
            touch.newtons = match waits {
                Some((carried, _)) => carried.touch.newtons_per_count.map(|newtons| newtons * total),
                None => touch.newtons.map(|_| 0.0),
            };
            touch.host_us = host_us;
            if let Some((carried, _)) = waits {
                let (contact, total) = (carried.touch.contact, touch.total);
                let age_us = carried.age_us(host_us);
                touch.parts = vec![RobotTouchPart { board: carried.board, contact, total, age_us }];
            }
            gone.push(present.shown.clone());
            waits.is_some()
        });
        gone
    }
}
