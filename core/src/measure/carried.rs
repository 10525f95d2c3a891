//! Moments of contacts that cross seams.
//!
//! A contact has the frame of its heaviest label on its home panel, the panel with most of its mass. Every
//! other label is carried into that frame along the joins that connect the two: the shortest path first, then
//! in the order of the joins. So a grip around a flank stays in one piece, and a ring that closes over two
//! seams is cut at the later one. Labels of the home panel that are connected only over another panel are
//! carried like all others.

use super::moments::Moments;
use crate::baseline::feedback::CARRIED;
use crate::garment::{Layout, PANELS, Transform};
use crate::segment::labeller::Labeller;
use crate::segment::seams::Joins;
use heapless::Vec;

/// A joined label, and its transform to the frame of its contact.
#[derive(Debug, Clone, Copy)]
struct Carried {
    label: u16,
    contact: u16,
    map: Transform,
    /// Moments so far, in the label's own coordinates.
    moments: Moments,
}

/// The joined labels of a frame; the heaviest of each contact's home panel has the identity.
#[derive(Debug, Clone)]
pub(crate) struct CarriedLabels {
    list: Vec<Carried, { 2 * CARRIED }>,
}

impl CarriedLabels {
    pub const fn new() -> Self {
        CarriedLabels { list: Vec::new() }
    }

    /// Returns the home panel of a joined contact, the one with most of its mass, and places all its labels.
    pub fn settle<const RUNS: usize, const LABELS: usize>(
        &mut self,
        labeller: &Labeller<RUNS, LABELS>,
        joins: &Joins,
        layout: &Layout,
        contact: u16,
    ) -> u8 {
        // Of each panel: mass, heaviest label, and mass of that label.
        let mut sums = [(0u64, 0, 0); PANELS];
        for (index, label) in labeller.roots().filter(|(_, label)| label.contact == contact) {
            if let Some((sum, heaviest, most)) = sums.get_mut(usize::from(label.panel)) {
                *sum = sum.wrapping_add(label.mass.into());
                if label.mass > *most {
                    (*heaviest, *most) = (index, label.mass);
                }
            }
        }
        let (mut home, mut anchor, mut greatest) = (0, 0, 0);
        for (panel, (sum, heaviest, _)) in (0u8..).zip(sums) {
            if sum > greatest {
                (home, anchor, greatest) = (panel, heaviest, sum);
            }
        }
        self.place(anchor, contact, Transform::IDENTITY);
        self.carry(joins, layout, contact);
        home
    }

    /// Places the labels at the other side of joins with one placed side, until none is left.
    fn carry(&mut self, joins: &Joins, layout: &Layout, contact: u16) {
        for _ in 0..=joins.list.len() {
            // Joins go only from labels that earlier rounds placed, so that the shortest path wins.
            let placed = self.list.len();
            for index in 0..joins.list.len() {
                let Some(join) = joins.list.get(index).copied() else { continue };
                let Some(joint) = layout.joints().get(usize::from(join.joint)) else { continue };
                let known = |label| self.list.iter().take(placed).find(|c| c.label == label).map(|c| c.map);
                match (known(join.a), known(join.b)) {
                    (Some(a), None) => self.place(join.b, contact, a.after(&joint.b_to_a)),
                    (None, Some(b)) => self.place(join.a, contact, b.after(&joint.b_to_a.inverse())),
                    _ => {}
                }
            }
            if self.list.len() == placed {
                return;
            }
        }
    }

    fn place(&mut self, label: u16, contact: u16, map: Transform) {
        if !self.list.iter().any(|c| c.label == label) {
            // Always room: each join brings at most two labels, and the list has twice the capacity of the
            // joins.
            let _ = self.list.push(Carried { label, contact, map, moments: Moments::default() });
        }
    }

    /// Moments of a label, if it is joined to another.
    pub fn moments_of(&mut self, label: u16) -> Option<&mut Moments> {
        self.list.iter_mut().find(|c| c.label == label).map(|c| &mut c.moments)
    }

    /// Contacts and the moments of their labels, in the frames of the contacts' home panels.
    pub fn moments(&self) -> impl Iterator<Item = (u16, Moments)> {
        self.list.iter().map(|c| (c.contact, c.moments.transform(&c.map)))
    }
}
