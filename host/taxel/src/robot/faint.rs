//! What touches a seam between boards, and is too faint to be a contact on its own board.
//!
//! Inside a panel, taxels that reach the low threshold belong to a contact if they are connected to it. Of a
//! touch on a seam between boards, the lesser part may not reach the high threshold, with which a contact
//! begins: its board does not report it. It is found here, in the board's image.

use super::file::ReadRobot;
use super::seam_taxels::seam_taxels;
use super::seam_value::SeamValue;
use super::touched::BoardTouch;
use crate::client::Client;
use std::collections::BTreeMap;
use taxel_core::body::Placed;
use taxel_core::condition::{Filter, WithheldTaxel};
use taxel_core::garment::{Layout, Place, Rect};

/// Finds what touches the seams of a board and is none of its contacts.
#[derive(Debug, Clone, Default)]
pub struct FaintFinder {
    layout: Layout,
    /// Taxels along the seams to other boards.
    edges: Vec<usize>,
    /// Taxels that adjoin a taxel across a seam of the garment itself.
    sewn: BTreeMap<usize, Vec<usize>>,
}

impl FaintFinder {
    /// Of a board of a robot; finds nothing if its garment is unknown or has no seam to another board.
    pub fn new(robot: &ReadRobot, board: usize) -> FaintFinder {
        let Some(worn) = robot.boards.get(board).and_then(|board| board.garment.as_ref()) else {
            return FaintFinder::default();
        };
        let layout = worn.layout.clone();
        let edges: Vec<usize> = seam_taxels(robot, board).iter().map(|at| at.taxel.into()).collect();
        let sewn = if edges.is_empty() { BTreeMap::new() } else { sewn(&layout) };
        FaintFinder { layout, edges, sewn }
    }

    /// What is found in the client's image; none if it has no image, or the board has no seams.
    pub fn find(&self, client: &Client) -> Option<Vec<BoardTouch>> {
        let (_, image) = client.image().filter(|_| !self.edges.is_empty())?;
        let low = client.worn()?.scene.contact.low;
        (image.len() == self.layout.taxels()).then(|| self.find_in(image, low, client.contacts()))
    }

    /// What presses along the seams in the client's image, of which its filter withheld this, by taxel; none if
    /// there is no image.
    pub fn edge(&self, client: &Client, withheld: &[WithheldTaxel]) -> Option<BTreeMap<u16, SeamValue>> {
        let (_, image) = client.image().filter(|_| !self.edges.is_empty())?;
        let is_persistent = client.worn()?.scene.condition.filter == Filter::Persistent;
        let value = |taxel: usize| {
            let of = withheld.iter().find(|of| usize::from(of.taxel) == taxel);
            of.map_or(image.get(taxel).copied().unwrap_or(0), |of| of.value)
        };
        let pressed = self.edges.iter().map(|edge| (*edge, value(*edge))).filter(|(_, value)| *value > 0);
        let told = |(edge, pressed): (usize, u16)| {
            let beside = neighbours(&self.layout, edge).map(value).max();
            let beside = beside.filter(|_| is_persistent).unwrap_or(u16::MAX);
            let told = image.get(edge).copied().unwrap_or(0);
            (edge as u16, SeamValue { told, value: pressed, beside })
        };
        Some(pressed.map(told).collect())
    }

    fn find_in(&self, image: &[u16], low: u16, contacts: &[Placed]) -> Vec<BoardTouch> {
        let mut found = Vec::new();
        let mut seen = Vec::new();
        for edge in self.edges.iter().copied().filter(|edge| image[*edge] >= low) {
            seen.resize(image.len(), false);
            if seen[edge] {
                continue;
            }
            let taxels = self.connected(edge, image, low, &mut seen);
            let is_contact = |placed: &Placed| {
                self.layout.taxel(placed.contact.peak_at).is_some_and(|peak| taxels.contains(&peak))
            };
            if !contacts.iter().any(is_contact) {
                found.extend(self.touch(edge, &taxels, image));
            }
        }
        found
    }

    /// The taxels from `low` on that are connected to this one, corners included.
    fn connected(&self, first: usize, image: &[u16], low: u16, seen: &mut [bool]) -> Vec<usize> {
        let mut taxels = vec![first];
        seen[first] = true;
        let mut next = 0;
        while let Some(taxel) = taxels.get(next).copied() {
            let sewn = self.sewn.get(&taxel).into_iter().flatten().copied();
            for beside in neighbours(&self.layout, taxel).chain(sewn) {
                if image[beside] >= low && !std::mem::replace(&mut seen[beside], true) {
                    taxels.push(beside);
                }
            }
            next += 1;
        }
        taxels
    }

    /// These taxels as a touch of the panel on which `edge` lies. What is beyond a seam of the garment itself
    /// counts for the pressure, not for the place.
    fn touch(&self, edge: usize, taxels: &[usize], image: &[u16]) -> Option<BoardTouch> {
        let panel = self.layout.place(edge)?.panel;
        let (mut total, mut here, mut at) = (0, 0.0, [0.0; 2]);
        let mut bounds = Rect { panel, top: u16::MAX, bottom: 0, left: u16::MAX, right: 0 };
        for taxel in taxels {
            total += u32::from(image[*taxel]);
            let Some(Place { row, column, .. }) = self.layout.place(*taxel).filter(|p| p.panel == panel)
            else {
                continue;
            };
            let weight = f64::from(image[*taxel]);
            here += weight;
            at = [at[0] + weight * f64::from(column), at[1] + weight * f64::from(row)];
            (bounds.top, bounds.bottom) = (bounds.top.min(row), bounds.bottom.max(row));
            (bounds.left, bounds.right) = (bounds.left.min(column), bounds.right.max(column));
        }
        Some(BoardTouch {
            contact: None,
            begins: false,
            panel,
            total,
            peak: taxels.iter().map(|taxel| image[*taxel]).max()?,
            area: taxels.len() as u16,
            bounds,
            centroid: at.map(|sum| sum / here),
            velocity: [0.0; 2],
            newtons_per_count: None,
        })
    }
}

/// The taxels around one on its panel, corners included.
fn neighbours(layout: &Layout, taxel: usize) -> impl Iterator<Item = usize> {
    let at = layout.place(taxel);
    let around = |at: u16| at.saturating_sub(1)..=at.saturating_add(1);
    let places = at.into_iter().flat_map(move |Place { panel, row, column }| {
        around(row).flat_map(move |row| around(column).map(move |column| Place { panel, row, column }))
    });
    places.filter_map(|place| layout.taxel(place)).filter(move |beside| *beside != taxel)
}

/// Taxels that adjoin each other across the garment's own seams.
fn sewn(layout: &Layout) -> BTreeMap<usize, Vec<usize>> {
    let mut sewn: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for joint in layout.joints() {
        let taxel = |panel: u8, (x, y): (i32, i32)| {
            layout.taxel(Place { panel, row: y.try_into().ok()?, column: x.try_into().ok()? })
        };
        for (a, b) in joint.neighbours() {
            if let (Some(a), Some(b)) = (taxel(joint.a, a), taxel(joint.b, b)) {
                sewn.entry(a).or_default().push(b);
                sewn.entry(b).or_default().push(a);
            }
        }
    }
    sewn
}
