//! Uncertainty of a force and of its place, by saturated and faulty taxels.
//!
//! A saturated taxel presses at least what it says. What a faulty one presses is unknown: between nothing,
//! and the most that its neighbours let expect, which is what the two next to it in a row or a column
//! continue to. Where the filter bridges it, the least of its neighbours is counted for it already. A touch
//! narrower than two taxels may hide in a faulty one: then its neighbours let expect less than it is.

use super::Micrometres;
use crate::format::{Inverse, root};
use crate::garment::{Layout, Place};
use serde::{Deserialize, Serialize};

/// By how much a force, its moment and its place may be off for the taxels that do not say what they feel.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// Number of saturated taxels: with one or more, forces and moments are the least that they may be.
    pub saturated: u16,
    /// Number of faulty taxels under the contact or at its edge.
    pub faulty: u16,
    /// The most by which these press less than is counted for them, counts.
    pub less: u32,
    /// The most by which they press more, counts.
    pub more: u32,
    /// The most by which they move the centre of pressure, um.
    pub off: u32,
}

impl Uncertainty {
    /// True if nothing is unknown.
    pub fn is_none(&self) -> bool {
        self.saturated == 0 && self.faulty == 0
    }
}

/// A faulty taxel under a contact or at its edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlindTaxel {
    pub taxel: u16,
    /// Number of the contact, and of the link on which the taxel lies.
    pub contact: u8,
    pub link: u8,
    /// Pressure that is counted for it, counts.
    pub counted: u16,
    /// The most that it presses.
    pub most: u16,
}

/// The most that a taxel presses, by its neighbours: in each direction, on from the second to the first.
pub(super) fn most_at(values: &[u16], layout: &Layout, place: Place) -> u16 {
    let Place { panel, row, column } = place;
    let at = |down: i16, right: i16| {
        let (row, column) = (row.checked_add_signed(down)?, column.checked_add_signed(right)?);
        values.get(layout.taxel(Place { panel, row, column })?).copied()
    };
    [(-1, 0), (1, 0), (0, -1), (0, 1)].into_iter().fold(0, |most, (down, right)| {
        let near = at(down, right).unwrap_or(0);
        let next = at(2 * down, 2 * right).unwrap_or(near);
        most.max(near).max(near.saturating_add(near.saturating_sub(next)))
    })
}

/// The uncertainty that faulty taxels leave; each with its distance from the centre of pressure, um. `total`
/// is the sum of all pressures, counts.
pub(super) fn of_faulty(blind: impl Iterator<Item = (BlindTaxel, u32)>, total: u32) -> Uncertainty {
    let (mut sum, mut moved) = (Uncertainty::default(), 0u64);
    for (BlindTaxel { counted, most, .. }, distance) in blind {
        sum.faulty = sum.faulty.saturating_add(1);
        let more = most.saturating_sub(counted);
        (sum.less, sum.more) =
            (sum.less.saturating_add(counted.into()), sum.more.saturating_add(more.into()));
        moved = moved.saturating_add(u64::from(distance) * u64::from(counted.max(more)));
    }
    // The others hold at least so much.
    let rest = total.saturating_sub(sum.less).max(1);
    sum.off = Inverse::of(rest).quotient(moved);
    sum
}

/// Distance of two points, um.
pub(super) fn distance(from: Micrometres, to: Micrometres) -> u32 {
    root(from.iter().zip(to).map(|(from, to)| u64::from(from.abs_diff(to)).pow(2)).sum())
}
