//! Contacts of all boards: what touches both sides of a seam between boards is one contact with one id.
//!
//! Boards scan at times of their own. Whenever a list of a board arrives, the newest contacts of the others
//! are carried on to its time by their velocities, by one scan of theirs at most. Two contacts of
//! neighbouring panels are joined if the boxes around them then meet at the seam; they stay joined until more
//! than a taxel lies between them. The oldest of the ids that are joined goes on. If a contact comes apart,
//! the greater part keeps the id.
//!
//! Pressure and place of a contact on several boards are those of the newest time that all of them have told:
//! what is newer is interpolated between a board's last two scans.
//!
//! A contact that ends at a seam is not over yet: for [`CROSSING_US`], and twice the time between the lists
//! of the board across, a contact that begins there, where it would be by its velocity, continues it.

use super::carried::{CarriedContact, PlaneBox};
use super::file::ReadRobot;
use super::plane::{PlaneSide, SeamPlane};
use super::scan::BoardScan;
use std::collections::BTreeMap;
use taxel_core::contact::{Contact, Phase};

/// Wait for a contact to go on across a seam, us, besides twice the time between lists.
pub const CROSSING_US: u64 = 30_000;
/// Greatest age of what is joined, us; of boards with fewer lists, twice the time between two.
const FRESH_US: u64 = 100_000;
/// Time between two lists of a board that has not sent two, us.
const USUAL_US: u64 = 20_000;
/// Longest time between two lists that is used, us.
const LONGEST_US: u64 = 500_000;
/// Distance from a seam within which a contact that ends may go on beyond it, mm: the gate within which a
/// board looks for its own contacts.
const GATE_MM: f64 = 40.0;
/// Distance of two boxes that meet, taxels: none, but places are rounded.
const MEETS: f64 = 0.5;
/// Distance up to which they stay joined.
const STAYS: f64 = 1.5;

/// A contact of the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotContact {
    /// Number of its onset, from 1 upwards; constant from onset to release.
    pub id: u32,
    /// Onset, held or released.
    pub phase: Phase,
    /// Host time of its onset, us since 1970.
    pub onset_us: u64,
    /// Host time for which pressure and place are told, us since 1970.
    pub host_us: u64,
    /// Number of the board on which most of it is.
    pub board: usize,
    /// Index of the panel there.
    pub panel: u8,
    /// Centroid, `[x, y]` in taxels of that panel, which goes on beyond its seams.
    pub centroid: [f64; 2],
    /// Sum of the pressure, counts; 0 once released.
    pub total: u32,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// Number of taxels.
    pub area: u32,
    /// The boards' contacts that it consists of. Of one that waits at a seam or is released, the last.
    pub parts: Vec<RobotContactPart>,
}

/// A board's contact as a part of the robot's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RobotContactPart {
    /// Number of the board.
    pub board: usize,
    /// Id of the contact there.
    pub contact: u32,
    /// Its pressure, counts.
    pub total: u32,
    /// Age of the board's list, us; below 0 if it is newer than that of the board that is told.
    pub age_us: i64,
}

/// Joins the contacts of all boards.
#[derive(Debug, Clone)]
pub struct RobotContacts {
    planes: Vec<SeamPlane>,
    boards: Vec<ListedBoard>,
    present: BTreeMap<u32, PresentContact>,
    ids: u32,
}

/// The last list of a board.
#[derive(Debug, Clone)]
struct ListedBoard {
    /// Host times of its last two scans, us; the same if there was one.
    scans_us: Option<[u64; 2]>,
    /// Time between two scans, us.
    interval_us: u64,
    contacts: Vec<ListedContact>,
}

impl Default for ListedBoard {
    fn default() -> ListedBoard {
        ListedBoard { scans_us: None, interval_us: USUAL_US, contacts: Vec::new() }
    }
}

impl ListedBoard {
    /// Notes the time of a scan, in the order of time. Returns the time since the one before, us; 0 if that
    /// is unknown or too long.
    fn scanned(&mut self, host_us: u64) -> u64 {
        let last = self.scans_us.map(|scans| scans[1]);
        if last != Some(host_us) {
            self.scans_us = Some([last.unwrap_or(host_us), host_us]);
            self.contacts.retain(|listed| !listed.has_ended);
        }
        let since = self.scans_us.and_then(|[before, last]| last.checked_sub(before));
        let interval_us = since.filter(|since| *since <= LONGEST_US).unwrap_or(0);
        if interval_us > 0 {
            self.interval_us = interval_us;
        }
        interval_us
    }
}

/// A contact of a list, and the robot's contact that it belongs to.
#[derive(Debug, Clone)]
struct ListedContact {
    carried: CarriedContact,
    id: Option<u32>,
    /// It has ended with the last scan; before that it was there.
    has_ended: bool,
}

#[derive(Debug, Clone)]
struct PresentContact {
    shown: RobotContact,
    /// Its last part, which ended at a seam, and the host's time until which it may go on beyond.
    waits: Option<(CarriedContact, u64)>,
}

/// Two contacts that meet: their indices, and the seam.
type SeamLink = (usize, usize, usize);
/// Index of a contact, and the way to it: place of the one through which it was found, and the sides that its
/// points pass on the way back.
type SeamWay<'a> = (usize, Option<(usize, &'a PlaneSide, &'a PlaneSide)>);

impl RobotContacts {
    /// No contacts yet.
    pub fn new(robot: &ReadRobot) -> RobotContacts {
        let planes = robot.seams.iter().filter_map(|seam| SeamPlane::of(seam, &robot.boards)).collect();
        let boards = vec![ListedBoard::default(); robot.boards.len()];
        RobotContacts { planes, boards, present: BTreeMap::new(), ids: 0 }
    }

    /// Takes a scan of a board, which began at the host's time, us. Returns the robot's contacts then, and
    /// those just released, by their ids; nothing if nothing touches, or nothing has changed.
    pub fn scan(&mut self, board: usize, scan: &BoardScan, host_us: u64) -> Vec<RobotContact> {
        match &scan.contacts {
            Some(contacts) => self.take(board, contacts, host_us),
            None => self.pass(board, host_us),
        }
    }

    /// Takes a board's list at the host's time of its frame, us. Returns the robot's contacts then, and
    /// those just released, by their ids.
    fn take(&mut self, board: usize, contacts: &[Contact], host_us: u64) -> Vec<RobotContact> {
        let Some(listed) = self.boards.get_mut(board) else { return Vec::new() };
        let interval_us = listed.scanned(host_us);
        let before = std::mem::take(&mut listed.contacts);
        let list = |contact: &Contact| {
            let is_it = |old: &&ListedContact| old.carried.contact.id == contact.id;
            let old = before.iter().find(is_it).filter(|_| contact.phase != Phase::Onset);
            let last = old.map(|old| &old.carried);
            let carried = CarriedContact::new(board, contact.clone(), host_us, interval_us, last);
            ListedContact { carried, id: old.and_then(|old| old.id), has_ended: false }
        };
        listed.contacts = contacts.iter().map(list).collect();
        let is_here = |old: &ListedContact| contacts.iter().any(|here| here.id == old.carried.contact.id);
        let ended: Vec<ListedContact> =
            before.into_iter().filter(|old| !old.has_ended && !is_here(old)).collect();
        for old in &ended {
            self.wait(old, host_us);
        }
        let end = |old: ListedContact| {
            let contact = Contact { total: 0, ..old.carried.contact.clone() };
            let carried = CarriedContact::new(board, contact, host_us, interval_us, Some(&old.carried));
            ListedContact { carried, has_ended: true, ..old }
        };
        self.boards[board].contacts.extend(ended.into_iter().map(end));
        self.join(host_us)
    }

    /// A board has scanned without a list. Returns the contacts that have waited in vain and are released,
    /// and the present ones with them.
    fn pass(&mut self, board: usize, host_us: u64) -> Vec<RobotContact> {
        if let Some(listed) = self.boards.get_mut(board) {
            listed.scanned(host_us);
        }
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
            *listed = ListedBoard::default();
        }
        self.join(host_us)
    }

    /// Lets the contact of a part that has ended wait, if it was its last one and is near a seam.
    fn wait(&mut self, old: &ListedContact, host_us: u64) {
        let Some(id) = old.id else { return };
        if self.listed().any(|listed| listed.id == Some(id) && !listed.has_ended) {
            return;
        }
        let across = |plane: &SeamPlane, at: usize| {
            let (here, there) = (&plane.sides[at], &plane.sides[1 - at]);
            let is_near = is_at(&old.carried, here)
                && old.carried.bounds(here, host_us).away <= GATE_MM
                && old.carried.bounds(here, host_us).is_along(plane.length, STAYS);
            is_near.then(|| self.boards[there.edge.board].interval_us)
        };
        let beside = self.planes.iter().flat_map(|plane| [across(plane, 0), across(plane, 1)]);
        let Some(interval_us) = beside.flatten().max() else { return };
        let patience_us = CROSSING_US + 2 * interval_us.max(old.carried.interval_us());
        if let Some(present) = self.present.get_mut(&id) {
            present.waits =
                Some((old.carried.clone().lasting(patience_us), host_us.saturating_add(patience_us)));
        }
    }

    fn listed(&self) -> impl Iterator<Item = &ListedContact> {
        self.boards.iter().flat_map(|board| &board.contacts)
    }

    /// Joins what meets, and gives each group its id.
    fn join(&mut self, host_us: u64) -> Vec<RobotContact> {
        let all: Vec<ListedContact> = self.listed().cloned().collect();
        let links = self.links(&all, host_us);
        let groups = groups(all.len(), &links);
        // Of an id that has come apart, the greater part keeps it.
        let mut keeps: BTreeMap<u32, (f64, usize)> = BTreeMap::new();
        for (listed, group) in all.iter().zip(&groups) {
            let Some(id) = listed.id else { continue };
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
        for (index, group) in groups.iter().enumerate() {
            if !ids.contains_key(group)
                && let Some(id) = self.waiting_for(&all[index].carried, host_us)
            {
                ids.insert(*group, id);
            }
        }
        let mut shown = Vec::new();
        for group in 0..all.len() {
            let members: Vec<usize> = (0..all.len()).filter(|index| groups[*index] == group).collect();
            if members.iter().all(|index| all[*index].has_ended) {
                ids.remove(&group);
                continue;
            }
            let id = *ids.entry(group).or_insert_with(|| {
                self.ids += 1;
                self.ids
            });
            shown.push(self.show(id, &all, &members, &links, host_us));
        }
        let listed = self.boards.iter_mut().flat_map(|board| &mut board.contacts);
        for (listed, group) in listed.zip(&groups) {
            listed.id = ids.get(group).copied().or(listed.id);
        }
        shown.extend(self.end(&ids, host_us));
        shown.sort_by_key(|contact| contact.id);
        shown
    }

    /// The pairs that meet at a seam.
    fn links(&self, all: &[ListedContact], host_us: u64) -> Vec<SeamLink> {
        let mut links = Vec::new();
        for (number, plane) in self.planes.iter().enumerate() {
            let boxes = |side: &PlaneSide| -> Vec<(usize, PlaneBox)> {
                let there = all
                    .iter()
                    .enumerate()
                    .filter(|(_, listed)| is_at(&listed.carried, side) && is_fresh(&listed.carried, host_us));
                there.map(|(index, listed)| (index, listed.carried.bounds(side, host_us))).collect()
            };
            let [here, there] = [boxes(&plane.sides[0]), boxes(&plane.sides[1])];
            for (a, box_a) in &here {
                for (b, box_b) in &there {
                    let is_joined = all[*a].id.is_some() && all[*a].id == all[*b].id;
                    if meet(plane, box_a, box_b, if is_joined { STAYS } else { MEETS }) {
                        links.push((*a, *b, number));
                    }
                }
            }
        }
        links
    }

    /// Id of a contact that waits at a seam, and that this one continues: the oldest.
    fn waiting_for(&self, new: &CarriedContact, host_us: u64) -> Option<u32> {
        let continues = |(old, _): &(CarriedContact, u64)| {
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

    /// The robot's contact of these members, which is remembered.
    fn show(
        &mut self,
        id: u32,
        all: &[ListedContact],
        members: &[usize],
        links: &[SeamLink],
        host_us: u64,
    ) -> RobotContact {
        let at_us = self.told_by_all(members.iter().map(|index| all[*index].carried.board), host_us);
        let total = |index: usize| all[index].carried.total(at_us);
        let most = |a: usize, b: usize| if total(b) > total(a) { b } else { a };
        let home = members.iter().copied().reduce(most).unwrap_or(0);
        let seen = self.seen_from(home, all, links, at_us);
        let (mut sum, mut at, mut peak, mut area) = (0.0, [0.0; 2], 0, 0);
        for (index, centroid) in &seen {
            let weight = total(*index).max(f64::MIN_POSITIVE);
            sum += weight;
            at = [at[0] + weight * centroid[0], at[1] + weight * centroid[1]];
            let contact = &all[*index].carried.contact;
            (peak, area) = (contact.peak.max(peak), area + u32::from(contact.area));
        }
        let part = |index: &usize| RobotContactPart {
            board: all[*index].carried.board,
            contact: all[*index].carried.contact.id,
            total: total(*index).round() as u32,
            age_us: all[*index].carried.age_us(host_us),
        };
        let is_there = |index: &&usize| !all[**index].has_ended;
        let before = self.present.get(&id);
        let carried = &all[home].carried;
        let shown = RobotContact {
            id,
            phase: before.map_or(Phase::Onset, |_| Phase::Held),
            onset_us: before.map_or(host_us, |before| before.shown.onset_us),
            board: carried.board,
            panel: carried.contact.panel,
            centroid: at.map(|sum_of| sum_of / sum),
            total: sum.round() as u32,
            peak,
            area,
            parts: members.iter().filter(is_there).map(part).collect(),
            host_us: at_us,
        };
        self.present.insert(id, PresentContact { shown: shown.clone(), waits: None });
        shown
    }

    /// The newest time for which all of these boards have told what touches them, us; boards that have been
    /// silent for long do not count.
    fn told_by_all(&self, boards: impl Iterator<Item = usize>, host_us: u64) -> u64 {
        let last = |board: usize| self.boards.get(board).and_then(|listed| listed.scans_us);
        let fresh = |[_, last]: &[u64; 2]| host_us.abs_diff(*last) <= FRESH_US;
        boards.filter_map(last).filter(fresh).map(|scans| scans[1]).min().unwrap_or(host_us).min(host_us)
    }

    /// What is linked to a contact, itself included: index, and centroid in taxels of its panel.
    fn seen_from(
        &self,
        home: usize,
        all: &[ListedContact],
        links: &[SeamLink],
        host_us: u64,
    ) -> Vec<(usize, [f64; 2])> {
        let mut found: Vec<SeamWay<'_>> = vec![(home, None)];
        let mut next = 0;
        while let Some((at, _)) = found.get(next).copied() {
            for (a, b, plane) in links {
                let [side_a, side_b] = &self.planes[*plane].sides;
                for (here, there, from, to) in [(*a, *b, side_b, side_a), (*b, *a, side_a, side_b)] {
                    if here == at && !found.iter().any(|(index, _)| *index == there) {
                        found.push((there, Some((next, from, to))));
                    }
                }
            }
            next += 1;
        }
        let centroid = |(index, _): &SeamWay<'_>| {
            let mut point = all[*index].carried.centroid(host_us);
            let mut way = found.iter().find(|(at, _)| at == index).and_then(|(_, way)| *way);
            while let Some((through, from, to)) = way {
                point = to.onto_panel(from.in_plane(point));
                way = found.get(through).and_then(|(_, way)| *way);
            }
            (*index, point)
        };
        found.iter().map(centroid).collect()
    }

    /// What is there no longer: it waits, or is released.
    fn end(&mut self, ids: &BTreeMap<usize, u32>, host_us: u64) -> Vec<RobotContact> {
        let mut gone = Vec::new();
        self.present.retain(|id, present| {
            if ids.values().any(|of_group| of_group == id) {
                return true;
            }
            let shown = &mut present.shown;
            let waits = present.waits.as_ref().filter(|(_, until)| host_us < *until);
            shown.phase = if waits.is_some() { Phase::Held } else { Phase::Released };
            let total = waits.map_or(0.0, |(carried, _)| carried.total(host_us));
            shown.total = total.round() as u32;
            shown.host_us = host_us;
            if let Some((carried, _)) = waits {
                let (contact, total, age_us) = (carried.contact.id, shown.total, carried.age_us(host_us));
                shown.parts = vec![RobotContactPart { board: carried.board, contact, total, age_us }];
            }
            gone.push(shown.clone());
            waits.is_some()
        });
        gone
    }
}

fn is_at(carried: &CarriedContact, side: &PlaneSide) -> bool {
    (carried.board, carried.contact.panel) == (side.edge.board, side.edge.panel)
}

fn is_fresh(carried: &CarriedContact, host_us: u64) -> bool {
    carried.age_us(host_us).unsigned_abs() <= FRESH_US.max(2 * carried.interval_us())
}

/// True if two boxes on the two sides of a seam have at most `slack` taxels between them. Where they were
/// carried to is known to half of the way.
fn meet(plane: &SeamPlane, a: &PlaneBox, b: &PlaneBox, slack: f64) -> bool {
    let pitch_mm = (plane.sides[0].pitch_mm() + plane.sides[1].pitch_mm()) / 2.0;
    let between = a.away.max(0.0) + b.away.max(0.0);
    let beside = a.along[0].max(b.along[0]) - a.along[1].min(b.along[1]);
    between <= slack * pitch_mm + (a.carried + b.carried) / 2.0
        && beside <= slack
        && a.is_along(plane.length, slack)
        && b.is_along(plane.length, slack)
}

/// Number of the group of each of so many contacts: the least index in it.
fn groups(count: usize, links: &[SeamLink]) -> Vec<usize> {
    let mut groups: Vec<usize> = (0..count).collect();
    for (a, b, _) in links {
        let (kept, joined) = (groups[*a].min(groups[*b]), groups[*a].max(groups[*b]));
        groups.iter_mut().filter(|group| **group == joined).for_each(|group| *group = kept);
    }
    groups
}
