//! Which touches of neighbouring boards meet at a time, and what they are together.

use super::carried::{CarriedTouch, PlaneBox};
use super::listed::{ListedBoard, ListedTouch};
use super::plane::{PlaneSide, SeamPlane};
use super::touch::{RobotTouch, RobotTouchPart};
use std::collections::{BTreeMap, BTreeSet};

/// Greatest age of what is joined, us; of boards with fewer scans, twice the time between two.
const FRESH_US: u64 = 100_000;
/// Distance of two boxes that meet, taxels: none, but places are rounded.
const MEETS: f64 = 0.5;
/// Distance up to which they stay joined.
pub const STAYS: f64 = 1.5;

/// All touches of all boards, joined where they meet.
#[derive(Debug)]
pub struct JoinedTouches<'a> {
    planes: &'a [SeamPlane],
    boards: &'a [ListedBoard],
    host_us: u64,
    /// What touches the boards.
    pub all: Vec<&'a ListedTouch>,
    links: Vec<SeamLink>,
    /// Of each of them the least index among those that it is joined with.
    pub groups: Vec<usize>,
}

/// Two touches that meet: their indices, and the seam.
type SeamLink = (usize, usize, usize);
/// Index of a touch, and the way to it: place of the one through which it was found, and the sides that its
/// points pass on the way back.
type SeamWay<'a> = (usize, Option<(usize, &'a PlaneSide, &'a PlaneSide)>);

impl<'a> JoinedTouches<'a> {
    /// What meets at the seams of these planes at a time of the host, us.
    pub fn new(planes: &'a [SeamPlane], boards: &'a [ListedBoard], host_us: u64) -> JoinedTouches<'a> {
        let all: Vec<&ListedTouch> = boards.iter().flat_map(ListedBoard::touches).collect();
        let (links, groups) = (Vec::new(), Vec::new());
        let mut joined = JoinedTouches { planes, boards, host_us, all, links, groups };
        joined.links = joined.links();
        joined.groups = groups_of(joined.all.len(), &joined.links);
        joined
    }

    /// Indices of what belongs to each group, by the group; groups without a contact are left out.
    pub fn contacts(&self) -> BTreeMap<usize, Vec<usize>> {
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (index, group) in self.groups.iter().enumerate() {
            members.entry(*group).or_default().push(index);
        }
        members.retain(|_, members| members.iter().any(|index| self.all[*index].is_contact()));
        members
    }

    /// The pairs that meet at a seam.
    fn links(&self) -> Vec<SeamLink> {
        let mut links = Vec::new();
        for (number, plane) in self.planes.iter().enumerate() {
            let boxes = |side: &PlaneSide| -> Vec<(usize, PlaneBox)> {
                let is_there =
                    |carried: &CarriedTouch| is_at(carried, side) && is_fresh(carried, self.host_us);
                let there = self.all.iter().enumerate().filter(|(_, listed)| is_there(&listed.carried));
                there.map(|(index, listed)| (index, listed.carried.bounds(side, self.host_us))).collect()
            };
            let here = boxes(&plane.sides[0]);
            let there = if here.is_empty() { Vec::new() } else { boxes(&plane.sides[1]) };
            for (a, box_a) in &here {
                for (b, box_b) in &there {
                    let slack = self.slack(self.all[*a], self.all[*b]);
                    if slack.is_some_and(|slack| meet(plane, box_a, box_b, slack)) {
                        links.push((*a, *b, number));
                    }
                }
            }
        }
        links
    }

    /// Distance up to which two touches are one, taxels; none if they never are.
    fn slack(&self, a: &ListedTouch, b: &ListedTouch) -> Option<f64> {
        let is_over = |listed: &ListedTouch| {
            let age_us = listed.carried.age_us(self.host_us);
            listed.has_ended && age_us > listed.carried.interval_us() as i64
        };
        match a.id.is_some() && a.id == b.id {
            true => Some(STAYS),
            false if is_over(a) || is_over(b) => None,
            false => Some(MEETS),
        }
    }

    /// What these touches are together.
    pub fn touch(&self, members: &[usize]) -> RobotTouch {
        let times = self.times(members);
        let total = |index: usize| -> f64 {
            times.iter().map(|(at_us, share)| share * self.all[index].carried.total(*at_us)).sum()
        };
        let most = |a: usize, b: usize| if total(b) > total(a) { b } else { a };
        let home = members.iter().copied().reduce(most).unwrap_or(0);
        let (mut sum, mut at, mut peak, mut area, mut newtons) = (0.0, [0.0; 2], 0, 0, Some(0.0));
        for (at_us, share) in &times {
            for (index, centroid) in self.seen_from(home, *at_us) {
                let weight = (share * self.all[index].carried.total(*at_us)).max(f64::MIN_POSITIVE);
                sum += weight;
                at = [at[0] + weight * centroid[0], at[1] + weight * centroid[1]];
            }
        }
        for index in members.iter().copied() {
            let touch = &self.all[index].carried.touch;
            (peak, area) = (touch.peak.max(peak), area + u32::from(touch.area));
            newtons = newtons.zip(touch.newtons_per_count).map(|(sum, each)| sum + each * total(index));
        }
        let part = |index: &usize| RobotTouchPart {
            board: self.all[*index].carried.board,
            contact: self.all[*index].carried.touch.contact,
            total: total(*index).round() as u32,
            age_us: self.all[*index].carried.age_us(self.host_us),
        };
        let is_there = |index: &&usize| !self.all[**index].has_ended;
        RobotTouch {
            host_us: mean_us(&times),
            board: self.all[home].carried.board,
            panel: self.all[home].carried.touch.panel,
            centroid: at.map(|sum_of| sum_of / sum),
            total: sum.round() as u32,
            newtons,
            peak,
            area,
            parts: members.iter().filter(is_there).map(part).collect(),
        }
    }

    /// The host's times, us, from which these touches are told, and the share of each; the shares sum up to 1.
    ///
    /// A touch on several boards is told from the newest scan of each of them, with its parts on the others
    /// interpolated. While it moves over a seam, one part loses what the other gains: where the sum with the
    /// first interpolated is too great, that with the second is too small. Shares in inverse proportion to these
    /// errors cancel them.
    fn times(&self, members: &[usize]) -> Vec<(u64, f64)> {
        let until_us = self.told_by_all(members);
        let all = || members.iter().map(|index| &self.all[*index].carried);
        let boards: BTreeSet<usize> = all().map(|touch| touch.board).collect();
        let time = |board: &usize| {
            let (own, others): (Vec<_>, Vec<_>) = all().partition(|touch| touch.board == *board);
            let at_us = own.iter().filter_map(|touch| touch.newest_until(until_us)).max()?;
            // Where another board has scanned at the same time, nothing is interpolated.
            let error = others.iter().map(|touch| touch.interpolation_error(at_us)).fold(1.0, f64::max);
            Some((at_us, 1.0 / error))
        };
        let mut times: Vec<(u64, f64)> =
            if boards.len() > 1 { boards.iter().filter_map(time).collect() } else { Vec::new() };
        if times.is_empty() {
            times.push((until_us, 1.0));
        }
        let sum: f64 = times.iter().map(|(_, share)| share).sum();
        times.iter_mut().for_each(|(_, share)| *share /= sum);
        times
    }

    /// The newest time for which all of these boards have told what touches them, us; boards that have been
    /// silent for long do not count.
    fn told_by_all(&self, members: &[usize]) -> u64 {
        let boards = members.iter().map(|index| self.all[*index].carried.board);
        let is_at_seam = boards.clone().any(|board| Some(board) != boards.clone().next());
        let told = |index: &usize| {
            let CarriedTouch { board, touch, .. } = &self.all[*index].carried;
            let board = &self.boards[*board];
            if is_at_seam { board.told_seams_us() } else { board.told_us(touch.contact.is_some()) }
        };
        let fresh = |told_us: &u64| self.host_us.abs_diff(*told_us) <= FRESH_US;
        members.iter().filter_map(told).filter(fresh).min().unwrap_or(self.host_us).min(self.host_us)
    }

    /// What is linked to a touch, itself included: index, and centroid in taxels of its panel.
    fn seen_from(&self, home: usize, host_us: u64) -> Vec<(usize, [f64; 2])> {
        let mut found: Vec<SeamWay<'_>> = vec![(home, None)];
        let mut next = 0;
        while let Some((at, _)) = found.get(next).copied() {
            for (a, b, plane) in &self.links {
                let [side_a, side_b] = &self.planes[*plane].sides;
                for (here, there, from, to) in [(*a, *b, side_b, side_a), (*b, *a, side_a, side_b)] {
                    if here == at && !found.iter().any(|(index, _)| *index == there) {
                        found.push((there, Some((next, from, to))));
                    }
                }
            }
            next += 1;
        }
        let centroid = |(index, way): &SeamWay<'_>| {
            let mut point = self.all[*index].carried.centroid(host_us);
            let mut way = *way;
            while let Some((through, from, to)) = way {
                point = to.onto_panel(from.in_plane(point));
                way = found.get(through).and_then(|(_, way)| *way);
            }
            (*index, point)
        };
        found.iter().map(centroid).collect()
    }
}

/// The mean of these times, us, by their shares.
fn mean_us(times: &[(u64, f64)]) -> u64 {
    let first_us = times.iter().map(|(at_us, _)| *at_us).min().unwrap_or(0);
    let later: f64 = times.iter().map(|(at_us, share)| (at_us - first_us) as f64 * share).sum();
    first_us + later.round() as u64
}

/// True if a touch is on the panel of a side.
pub fn is_at(carried: &CarriedTouch, side: &PlaneSide) -> bool {
    (carried.board, carried.touch.panel) == (side.edge.board, side.edge.panel)
}

fn is_fresh(carried: &CarriedTouch, host_us: u64) -> bool {
    carried.age_us(host_us).unsigned_abs() <= FRESH_US.max(2 * carried.interval_us())
}

/// True if two boxes on the two sides of a seam have at most `slack` taxels between them. Where they were
/// carried to is known to half of the way.
pub fn meet(plane: &SeamPlane, a: &PlaneBox, b: &PlaneBox, slack: f64) -> bool {
    let pitch_mm = (plane.sides[0].pitch_mm() + plane.sides[1].pitch_mm()) / 2.0;
    let between = a.away.max(0.0) + b.away.max(0.0);
    let beside = a.along[0].max(b.along[0]) - a.along[1].min(b.along[1]);
    between <= slack * pitch_mm + (a.carried + b.carried) / 2.0
        && beside <= slack
        && a.is_along(plane.length, slack)
        && b.is_along(plane.length, slack)
}

/// Number of the group of each of so many touches: the least index in it.
fn groups_of(count: usize, links: &[SeamLink]) -> Vec<usize> {
    let mut groups: Vec<usize> = (0..count).collect();
    for (a, b, _) in links {
        let (kept, joined) = (groups[*a].min(groups[*b]), groups[*a].max(groups[*b]));
        groups.iter_mut().filter(|group| **group == joined).for_each(|group| *group = kept);
    }
    groups
}
