//! Joins of labels across seams.
//!
//! Each pair of labels that neighbour taxels of a seam connect is joined once.

use super::bits::{lowest_run, run_of};
use super::borders::SideCursor;
use super::labeller::Labeller;
use super::union_find::{Label, NONE};
use crate::baseline::feedback::CARRIED;
use crate::garment::{Joint, Layout};
use core::ops::Range;
use heapless::Vec;

/// Two labels that a seam connects, `a` on the first panel of its joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Join {
    pub a: u16,
    pub b: u16,
    /// Index of the seam's joint.
    pub joint: u8,
}

/// State of the walk along a seam.
struct SeamWalk<'a> {
    /// Index of the joint.
    index: u8,
    joint: &'a Joint,
    beside: SideCursor<'a>,
    /// The label last looked at, and the last label found beside it, or [`NONE`].
    label: u16,
    there: u16,
    /// Last taxel of the other side that was looked at for this label.
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

    /// Joins the labels of a frame across all seams.
    pub fn find<const RUNS: usize, const LABELS: usize>(
        &mut self,
        labeller: &mut Labeller<RUNS, LABELS>,
        layout: &Layout,
    ) {
        self.list.clear();
        self.overflow = 0;
        for (index, joint) in (0u8..).zip(layout.joints()) {
            // Most frames end here: no run touches the seam's side of one of the two panels.
            if labeller.touches(joint.a, joint.edge_a.side) && labeller.touches(joint.b, joint.edge_b.side) {
                self.find_along(index, joint, labeller, layout);
            }
        }
        for join in &self.list {
            unite(&mut labeller.labels, join.a, join.b);
        }
    }

    /// Joins along one seam: walks the labels of panel `a`, and for each of them the labels beside it on
    /// panel `b`.
    #[inline(never)] // own frame: locals stay within short SP offsets
    fn find_along<const RUNS: usize, const LABELS: usize>(
        &mut self,
        index: u8,
        joint: &Joint,
        labeller: &Labeller<RUNS, LABELS>,
        layout: &Layout,
    ) {
        let areas = layout.areas();
        let (Some(area_a), Some(area_b)) = (areas.get(usize::from(joint.a)), areas.get(usize::from(joint.b)))
        else {
            return;
        };
        let beside = SideCursor::of(labeller, area_b, &joint.edge_b);
        let mut walk = SeamWalk { index, joint, beside, label: NONE, there: NONE, seen: -1 };
        let end = i32::from(joint.length);
        let ((left, top), (right, _)) = (joint.edge_a.at(0), joint.edge_a.at(end - 1));
        if left == right {
            let mut side = SideCursor::of(labeller, area_a, &joint.edge_a);
            let mut at = 0;
            while at < end {
                let (label, taxels) = side.from(at);
                if label != NONE && taxels.start < end {
                    self.step(&mut walk, label, taxels.start, taxels.end.min(end) - 1);
                }
                at = taxels.end;
            }
            return;
        }
        let row = area_a.first_row.wrapping_add_signed(top as i16);
        for (_, run) in labeller.in_rows(row, row) {
            let Some(label) = labeller.label_of(run) else { continue };
            let at = i32::from(run.column()) - left;
            let mut rest = run.within(left as u16, right as u16);
            while rest != 0 {
                let Range { start, end } = run_of(lowest_run(rest));
                rest &= !lowest_run(rest);
                self.step(&mut walk, label, at + start as i32, at + end as i32 - 1);
            }
        }
    }

    /// Joins a label that has the taxels `first ..= last` along the seam to the labels beside them.
    #[inline(never)] // M0+: out of line
    fn step(&mut self, walk: &mut SeamWalk, label: u16, first: i32, last: i32) {
        if walk.label != label {
            (walk.label, walk.there, walk.seen) = (label, NONE, -1);
        }
        let near = walk.joint.beside(first, last);
        let mut at = (walk.seen + 1).max(*near.start());
        while at <= *near.end() {
            let (there, taxels) = walk.beside.from(at);
            if there != NONE && there != walk.there && taxels.start <= *near.end() {
                walk.there = there;
                self.note(Join { a: label, b: there, joint: walk.index });
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

/// Returns the root among the labels that seams join to `label`.
fn group(labels: &[Label], mut label: u16) -> u16 {
    while let Some(held) = labels.get(usize::from(label)) {
        if held.group >= label {
            break;
        }
        label = held.group;
    }
    label
}

fn unite(labels: &mut [Label], a: u16, b: u16) {
    let (first, second) = (group(labels, a).min(group(labels, b)), group(labels, a).max(group(labels, b)));
    for label in [a, b] {
        if let Some(label) = labels.get_mut(usize::from(label)) {
            label.joined = true;
        }
    }
    if let Some(label) = labels.get_mut(usize::from(second)) {
        label.group = first;
    }
}

/// Returns total, peak, area and `held` of a contact, over all labels that seams join to its first label.
pub(crate) fn weigh<const RUNS: usize, const LABELS: usize>(
    labeller: &Labeller<RUNS, LABELS>,
    first: u16,
) -> (u32, u16, u16, bool) {
    let mut sum = (0u32, 0u16, 0u16, false);
    for (index, label) in labeller.roots() {
        if index == first || (label.joined && group(&labeller.labels, index) == first) {
            sum.0 = sum.0.wrapping_add(label.mass);
            sum.1 = sum.1.max(label.peak as u16);
            sum.2 = sum.2.saturating_add(label.area);
            sum.3 |= label.held;
        }
    }
    sum
}
