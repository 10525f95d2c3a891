//! Recent news of boards, aligned by the time that they share.

use super::contact::BoardContact;
use crate::client::Stamp;
use std::collections::VecDeque;
use std::time::Duration;

/// Recent news of the boards of a robot: the newest by a time of the host, or what was between.
///
/// Stamps are those of [`RobotEvent`](super::RobotEvent)s: a board's own clock, brought to the host's time by round
/// trips, with the bound of what that may be off.
#[derive(Debug, Clone)]
pub struct RobotMoments<T> {
    kept_us: u64,
    boards: Vec<VecDeque<BoardMoment<T>>>,
}

/// News of a board, and when it was.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardMoment<T> {
    /// Time of the news.
    pub stamp: Stamp,
    /// News that it has reported.
    pub what: T,
}

impl<T> RobotMoments<T> {
    /// Makes room for so many boards, each for so long.
    pub fn new(boards: usize, kept: Duration) -> RobotMoments<T> {
        let kept_us = u64::try_from(kept.as_micros()).unwrap_or(u64::MAX);
        RobotMoments { kept_us, boards: (0..boards).map(|_| VecDeque::new()).collect() }
    }

    /// Takes what a board has said. What it has said of the same time and later ones is forgotten: its clock
    /// has been learned anew. Nothing happens if there is no such board.
    pub fn take(&mut self, board: usize, stamp: Stamp, what: T) {
        let Some(moments) = self.boards.get_mut(board) else { return };
        while moments.back().is_some_and(|last| last.stamp.host_us >= stamp.host_us) {
            moments.pop_back();
        }
        moments.push_back(BoardMoment { stamp, what });
        let oldest_us = stamp.host_us.saturating_sub(self.kept_us);
        // One from before that is what was newest then.
        while moments.get(1).is_some_and(|second| second.stamp.host_us <= oldest_us) {
            moments.pop_front();
        }
    }

    /// Forgets what a board has said: it is lost.
    pub fn forget(&mut self, board: usize) {
        self.boards.get_mut(board).into_iter().for_each(VecDeque::clear);
    }

    /// The newest time of the host, us, until which all of these boards have said something. Boards that have
    /// said nothing yet do not count; none if none has.
    pub fn reported_by_all(&self, boards: impl IntoIterator<Item = usize>) -> Option<u64> {
        let newest = |board: usize| Some(self.boards.get(board)?.back()?.stamp.host_us);
        boards.into_iter().filter_map(newest).min()
    }

    /// The newest that a board has said until a time of the host, us; none if that is forgotten, or it had said
    /// nothing yet.
    pub fn latest(&self, board: usize, host_us: u64) -> Option<&BoardMoment<T>> {
        self.around(board, host_us).map(|(before, _)| before)
    }

    /// Returns that, and what the board has said next, if it has.
    pub fn around(&self, board: usize, host_us: u64) -> Option<(&BoardMoment<T>, Option<&BoardMoment<T>>)> {
        let moments = self.boards.get(board)?;
        let after = moments.partition_point(|moment| moment.stamp.host_us <= host_us);
        Some((moments.get(after.checked_sub(1)?)?, moments.get(after)))
    }
}

impl RobotMoments<Vec<BoardContact>> {
    /// Contacts of a board at a time of the host, us, interpolated between two lists. What has ended or begun
    /// between them fades out or in where it is. After the newest list it is that one, with its own stamp. None
    /// as of [`RobotMoments::latest`].
    pub fn contacts(&self, board: usize, host_us: u64) -> Option<BoardMoment<Vec<BoardContact>>> {
        let (before, after) = self.around(board, host_us)?;
        let Some(after) = after else { return Some(before.clone()) };
        let [a, b] = [before.stamp, after.stamp];
        let part = (host_us - a.host_us) as f64 / (b.host_us - a.host_us) as f64;
        let board_us = between(a.board_us as f64, b.board_us as f64, part) as u64;
        let uncertainty_us = a.uncertainty_us.zip(b.uncertainty_us).map(|(a, b)| a.max(b));
        let stamp = Stamp { board_us, host_us, uncertainty_us };
        let same =
            |of: &BoardContact, list: &[BoardContact]| list.iter().find(|other| other.id == of.id).cloned();
        let mut contacts = Vec::new();
        for contact in &before.what {
            contacts.push(match same(contact, &after.what) {
                Some(later) => contact_between(contact, &later, part),
                None => BoardContact { total: scaled(contact.total, 1.0 - part), ..contact.clone() },
            });
        }
        for contact in after.what.iter().filter(|contact| same(contact, &before.what).is_none()) {
            contacts.push(BoardContact { total: scaled(contact.total, part), ..contact.clone() });
        }
        Some(BoardMoment { stamp, what: contacts })
    }
}

/// A contact between two scans; what has no values between is that of the nearer one.
fn contact_between(a: &BoardContact, b: &BoardContact, part: f64) -> BoardContact {
    let nearer = if part < 0.5 { a } else { b };
    let both = |value: fn(&BoardContact) -> f64| between(value(a), value(b), part);
    let mut contact = BoardContact {
        total: both(|contact| f64::from(contact.total)).round() as u32,
        peak: both(|contact| f64::from(contact.peak)).round() as u16,
        area: both(|contact| f64::from(contact.area)).round() as u16,
        ..nearer.clone()
    };
    // On another panel the axes are others.
    if a.panel == b.panel {
        contact.centroid = [0, 1].map(|axis| between(a.centroid[axis], b.centroid[axis], part));
        contact.velocity = [0, 1].map(|axis| between(a.velocity[axis], b.velocity[axis], part));
    }
    contact
}

fn between(a: f64, b: f64, part: f64) -> f64 {
    a + (b - a) * part
}

fn scaled(total: u32, part: f64) -> u32 {
    (f64::from(total) * part).round() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::Rect;

    fn stamp(host_us: u64, uncertainty_us: u64) -> Stamp {
        Stamp { board_us: host_us - 1000, host_us, uncertainty_us: Some(uncertainty_us) }
    }

    fn contact(id: u32, panel: u8, total: u32, x: f64) -> BoardContact {
        BoardContact {
            id,
            panel,
            total,
            peak: 10,
            area: 4,
            bounds: Rect { panel, top: 0, bottom: 1, left: 0, right: 1 },
            centroid: [x, 1.0],
            velocity: [0.0; 2],
            newtons_per_count: None,
        }
    }

    #[test]
    fn the_newest_by_a_time_is_found_as_long_as_it_is_kept() {
        let mut moments = RobotMoments::new(2, Duration::from_millis(2));
        for host_us in [2_000, 3_000, 4_000, 6_500] {
            moments.take(1, stamp(host_us, 5), host_us);
        }
        let latest =
            |moments: &RobotMoments<u64>, host_us| moments.latest(1, host_us).map(|found| found.what);
        // What was newest 2 ms before the last is kept.
        assert_eq!(
            [3_999, 4_000, 5_000, 9_000].map(|us| latest(&moments, us)),
            [None, Some(4_000), Some(4_000), Some(6_500)]
        );
        assert_eq!([moments.reported_by_all([0]), moments.reported_by_all([0, 1, 2])], [None, Some(6_500)]);
        moments.take(0, stamp(6_000, 5), 0);
        assert_eq!(moments.reported_by_all([0, 1]), Some(6_000));
        moments.forget(0);
        assert!(moments.latest(0, 9_000).is_none() && moments.latest(2, 9_000).is_none());
        // A clock that is learned anew may go back.
        moments.take(1, stamp(5_000, 5), 1);
        assert_eq!(latest(&moments, 9_000), Some(1));
        moments.forget(1);
        assert_eq!(latest(&moments, 9_000), None);
    }

    #[test]
    fn contacts_are_interpolated_between_two_lists() {
        let mut moments = RobotMoments::new(1, Duration::from_secs(1));
        moments.take(
            0,
            stamp(2_000, 5),
            vec![contact(1, 0, 100, 2.0), contact(2, 0, 40, 7.0), contact(4, 0, 10, 1.0)],
        );
        moments.take(
            0,
            stamp(6_000, 9),
            vec![contact(1, 0, 200, 4.0), contact(3, 0, 80, 5.0), contact(4, 1, 10, 9.0)],
        );
        let at = moments.contacts(0, 3_000).unwrap();
        assert_eq!((at.stamp.host_us, at.stamp.board_us, at.stamp.uncertainty_us), (3_000, 2_000, Some(9)));
        let reported: Vec<_> = at.what.iter().map(|t| (t.id, t.panel, t.total, t.centroid[0])).collect();
        assert_eq!(reported, [(1, 0, 125, 2.5), (2, 0, 30, 7.0), (4, 0, 10, 1.0), (3, 0, 20, 5.0)]);
        let later = moments.contacts(0, 5_000).unwrap();
        assert_eq!(later.what.iter().find(|t| t.id == 4).unwrap().panel, 1);
        let last = moments.contacts(0, 90_000).unwrap();
        assert_eq!((last.stamp.host_us, last.what.len()), (6_000, 3));
        assert!(moments.contacts(0, 1_999).is_none());
    }
}
