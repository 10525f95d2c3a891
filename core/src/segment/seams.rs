//! Joins of parts across seams.
//!
//! Each pair of parts that neighbour taxels of a seam connect is joined once.

use super::bits::{lowest_run, run_of};
use super::borders::Side;
use super::labels::Labels;
use super::union_find::{NONE, Part};
use crate::baseline::feedback::CARRIED;
use crate::garment::{Joint, Layout};
use core::ops::Range;
use heapless::Vec;

/// Two parts that a seam connects, `a` on the first panel of its joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Join {
    pub a: u16,
    pub b: u16,
    /// Index of the seam's joint.
    pub joint: u8,
}

/// State of the walk along a seam.
struct Walk<'a> {
    /// Index of the joint.
    index: u8,
    joint: &'a Joint,
    beside: Side<'a>,
    /// The part last looked at, and the last part found beside it, or [`NONE`].
    part: u16,
    there: u16,
    /// Last taxel of the other side that was looked at for this part.
    seen: i32,
}

/// The joins of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Joins {
    pub list: Vec<Join, CARRIED>,
    /// Number of joins of this frame that did not fit: the contacts stay apart.
    pub overflow: u16,
}

impl Joins {
    pub const fn new() -> Self {
        Joins { list: Vec::new(), overflow: 0 }
    }

    /// Joins the parts of a frame across all seams.
    pub fn find<const RUNS: usize, const PARTS: usize>(
        &mut self,
        labels: &mut Labels<RUNS, PARTS>,
        layout: &Layout,
    ) {
        self.list.clear();
        self.overflow = 0;
        for (index, joint) in (0u8..).zip(layout.joints()) {
            // Most frames end here: no piece touches the seam's side of one of the two panels.
            if labels.touches(joint.a, joint.edge_a.side) && labels.touches(joint.b, joint.edge_b.side) {
                self.find_along(index, joint, labels, layout);
            }
        }
        for join in &self.list {
            unite(&mut labels.parts, join.a, join.b);
        }
    }

    /// Joins along one seam: walks the parts of panel `a`, and for each of them the parts beside it on panel
    /// `b`.
    #[inline(never)] // own frame: locals stay within short SP offsets
    fn find_along<const RUNS: usize, const PARTS: usize>(
        &mut self,
        index: u8,
        joint: &Joint,
        labels: &Labels<RUNS, PARTS>,
        layout: &Layout,
    ) {
        let areas = layout.areas();
        let (Some(area_a), Some(area_b)) = (areas.get(usize::from(joint.a)), areas.get(usize::from(joint.b)))
        else {
            return;
        };
        let beside = Side::of(labels, area_b, &joint.edge_b);
        let mut walk = Walk { index, joint, beside, part: NONE, there: NONE, seen: -1 };
        let end = i32::from(joint.length);
        let ((left, top), (right, _)) = (joint.edge_a.at(0), joint.edge_a.at(end - 1));
        if left == right {
            let mut side = Side::of(labels, area_a, &joint.edge_a);
            let mut at = 0;
            while at < end {
                let (part, taxels) = side.from(at);
                if part != NONE && taxels.start < end {
                    self.step(&mut walk, part, taxels.start, taxels.end.min(end) - 1);
                }
                at = taxels.end;
            }
            return;
        }
        let row = area_a.first_row.wrapping_add_signed(top as i16);
        for (_, piece) in labels.in_rows(row, row) {
            let Some(part) = labels.part_of(piece) else { continue };
            let at = i32::from(piece.column()) - left;
            let mut rest = piece.within(left as u16, right as u16);
            while rest != 0 {
                let Range { start, end } = run_of(lowest_run(rest));
                rest &= !lowest_run(rest);
                self.step(&mut walk, part, at + start as i32, at + end as i32 - 1);
            }
        }
    }

    /// Joins a part that has the taxels `first ..= last` along the seam to the parts beside them.
    #[inline(never)] // M0+: out of line
    fn step(&mut self, walk: &mut Walk, part: u16, first: i32, last: i32) {
        if walk.part != part {
            (walk.part, walk.there, walk.seen) = (part, NONE, -1);
        }
        let near = walk.joint.beside(first, last);
        let mut at = (walk.seen + 1).max(*near.start());
        while at <= *near.end() {
            let (there, taxels) = walk.beside.from(at);
            if there != NONE && there != walk.there && taxels.start <= *near.end() {
                walk.there = there;
                self.note(Join { a: part, b: there, joint: walk.index });
            }
            at = taxels.end;
        }
        walk.seen = walk.seen.max(*near.end());
    }

    fn note(&mut self, join: Join) {
        if join.a != join.b && !self.list.contains(&join) && self.list.push(join).is_err() {
            self.overflow = self.overflow.saturating_add(1);
        }
    }
}

/// Returns the root among the parts that seams join to `part`.
fn group(parts: &[Part], mut part: u16) -> u16 {
    while let Some(held) = parts.get(usize::from(part)) {
        if held.group >= part {
            break;
        }
        part = held.group;
    }
    part
}

fn unite(parts: &mut [Part], a: u16, b: u16) {
    let (first, second) = (group(parts, a).min(group(parts, b)), group(parts, a).max(group(parts, b)));
    for part in [a, b] {
        if let Some(part) = parts.get_mut(usize::from(part)) {
            part.joined = true;
        }
    }
    if let Some(part) = parts.get_mut(usize::from(second)) {
        part.group = first;
    }
}

/// Returns total, peak, area and `held` of a contact, over all parts that seams join to its first part.
pub(crate) fn weigh<const RUNS: usize, const PARTS: usize>(
    labels: &Labels<RUNS, PARTS>,
    first: u16,
) -> (u32, u16, u16, bool) {
    let mut sum = (0u32, 0u16, 0u16, false);
    for (index, part) in labels.whole_parts() {
        if index == first || (part.joined && group(&labels.parts, index) == first) {
            sum.0 = sum.0.wrapping_add(part.mass);
            sum.1 = sum.1.max(part.peak as u16);
            sum.2 = sum.2.saturating_add(part.area);
            sum.3 |= part.held;
        }
    }
    sum
}
