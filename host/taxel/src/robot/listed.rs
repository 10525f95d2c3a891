//! What a board has told last of what touches it.

use super::carried::CarriedTouch;
use super::edges::SeamEdges;
use super::touched::BoardTouch;

/// Time between two scans of a board that has not told two, us.
const USUAL_US: u64 = 20_000;
/// Longest time between two scans that is used, us.
const LONGEST_US: u64 = 500_000;

/// What a board has told last.
#[derive(Debug, Clone)]
pub struct ListedBoard {
    /// Number of the board.
    board: usize,
    /// Host time of its last scan, us.
    scanned_us: Option<u64>,
    /// Time between two scans, us.
    interval_us: u64,
    /// Host time of its last image, us.
    imaged_us: Option<u64>,
    /// Its contacts, then those that have just ended.
    pub contacts: Vec<ListedTouch>,
    /// What touches a seam and is too faint to be a contact, then what was one.
    pub faint: Vec<ListedTouch>,
}

/// A touch of a board, and the robot's contact that it belongs to.
#[derive(Debug, Clone)]
pub struct ListedTouch {
    /// The touch.
    pub carried: CarriedTouch,
    /// Id of the robot's contact.
    pub id: Option<u32>,
    /// It has ended with its last scan; before that it was there.
    pub has_ended: bool,
}

impl ListedTouch {
    /// True for a contact of its board, present now.
    pub fn is_contact(&self) -> bool {
        self.carried.touch.contact.is_some() && !self.has_ended
    }

    /// The same once a scan has told that it is over.
    fn over(self, host_us: u64, interval_us: u64) -> ListedTouch {
        let touch = BoardTouch { total: 0, ..self.carried.touch.clone() };
        let carried = CarriedTouch::new(self.carried.board, touch, host_us, interval_us, Some(self.carried));
        ListedTouch { carried, has_ended: true, id: self.id }
    }
}

impl ListedBoard {
    /// A board that has told nothing yet.
    pub fn new(board: usize) -> ListedBoard {
        ListedBoard {
            board,
            scanned_us: None,
            interval_us: USUAL_US,
            imaged_us: None,
            contacts: Vec::new(),
            faint: Vec::new(),
        }
    }

    /// Time between two scans, us.
    pub fn interval_us(&self) -> u64 {
        self.interval_us
    }

    /// Host time until which it has told its contacts, or what is too faint for that, us.
    pub fn told_us(&self, contacts: bool) -> Option<u64> {
        if contacts { self.scanned_us } else { self.imaged_us }
    }

    /// Host time until which it has told what touches its seams, us: that of its last image, if one comes with
    /// each scan.
    pub fn told_seams_us(&self) -> Option<u64> {
        let is_recent = |imaged_us: &u64| {
            self.scanned_us.is_none_or(|at| at.saturating_sub(*imaged_us) <= self.interval_us * 3 / 2)
        };
        self.imaged_us.filter(is_recent).or(self.scanned_us)
    }

    /// What touches it, and what has just ended.
    pub fn touches(&self) -> impl Iterator<Item = &ListedTouch> {
        self.contacts.iter().chain(&self.faint)
    }

    /// What touches it, in the same order.
    pub fn touches_mut(&mut self) -> impl Iterator<Item = &mut ListedTouch> {
        self.contacts.iter_mut().chain(&mut self.faint)
    }

    /// Notes the time of a scan, in the order of time.
    pub fn scanned(&mut self, host_us: u64) {
        let before = self.scanned_us.replace(host_us);
        let since = before.and_then(|before| host_us.checked_sub(before));
        if let Some(since) = since.filter(|since| (1..=LONGEST_US).contains(since)) {
            self.interval_us = since;
        }
    }

    /// Forgets what has ended so long ago.
    pub fn forget_ended(&mut self, host_us: u64, after_us: u64) {
        let is_kept =
            |listed: &ListedTouch| !listed.has_ended || listed.carried.age_us(host_us) <= after_us as i64;
        self.contacts.retain(is_kept);
        self.faint.retain(is_kept);
    }

    /// Takes the contacts of the scan that was noted last. Returns those that are not there any
    /// longer, as they were.
    pub fn list(&mut self, contacts: &[BoardTouch], host_us: u64) -> Vec<ListedTouch> {
        let interval_us = self.interval_us;
        let (mut before, mut gone): (Vec<ListedTouch>, Vec<ListedTouch>) =
            std::mem::take(&mut self.contacts).into_iter().partition(|listed| !listed.has_ended);
        for contact in contacts {
            let is_it = |old: &ListedTouch| old.carried.touch.contact == contact.contact;
            let at = before.iter().position(is_it);
            let old = match at.map(|at| before.swap_remove(at)) {
                Some(old) if !contact.begins => Some(old),
                // It may have been too faint until now.
                _ => self.take_faint_beside(contact),
            };
            let (id, old) = old.map_or((None, None), |old| (old.id, Some(old.carried)));
            let carried = CarriedTouch::new(self.board, contact.clone(), host_us, interval_us, old);
            self.contacts.push(ListedTouch { carried, id, has_ended: false });
        }
        self.contacts.append(&mut gone);
        self.contacts.extend(before.iter().cloned().map(|old| old.over(host_us, interval_us)));
        before
    }

    /// Makes of its touches what they are with what presses beyond its seams, as far as the edges now tell.
    pub fn change(&mut self, edges: &SeamEdges) {
        for (host_us, mut changes) in edges.changes(self.board) {
            self.touches_mut().for_each(|listed| listed.carried.change(host_us, &mut changes));
        }
    }

    /// Takes what is too faint in an image.
    pub fn image(&mut self, faint: &[BoardTouch], host_us: u64) {
        let interval_us = self.imaged_us.and_then(|before| host_us.checked_sub(before));
        let interval_us = interval_us.filter(|since| *since <= LONGEST_US).unwrap_or(0);
        self.imaged_us = Some(host_us);
        let mut found = Vec::new();
        for touch in faint {
            let old = self.take_faint_beside(touch);
            let (id, old) = old.map_or((None, None), |old| (old.id, Some(old.carried)));
            let carried = CarriedTouch::new(self.board, touch.clone(), host_us, interval_us, old);
            found.push(ListedTouch { carried, id, has_ended: false });
        }
        let over = |old: ListedTouch| if old.has_ended { old } else { old.over(host_us, interval_us) };
        found.extend(std::mem::take(&mut self.faint).into_iter().map(over));
        self.faint = found;
    }

    /// Takes out what was too faint where this touch is now: what was greatest.
    fn take_faint_beside(&mut self, touch: &BoardTouch) -> Option<ListedTouch> {
        let beside = |listed: &ListedTouch| !listed.has_ended && listed.carried.touch.is_beside(touch);
        let all = self.faint.iter().enumerate().filter(|(_, listed)| beside(listed));
        let (at, _) = all.max_by_key(|(_, listed)| listed.carried.touch.total)?;
        Some(self.faint.swap_remove(at))
    }
}
