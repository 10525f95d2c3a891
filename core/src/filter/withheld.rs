//! What the filter withholds at the edges of panels.
//!
//! To the filter a panel ends at its edge. A taxel there that exceeds all of its neighbours on the panel counts
//! as an impulse until it lasts, although more may press beyond the edge, on the panel of another board. Only
//! the host knows both: it is told what was withheld, and judges.

use super::points::{POINTS, Points, stands_out};
use crate::garment::{Layout, Place};
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// A taxel at the edge of a panel, of which the filter withholds more than noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct WithheldTaxel {
    /// Number of the taxel.
    pub taxel: u16,
    /// Its pressure before the filter, counts.
    pub value: u16,
    /// Its pressure after the filter, counts.
    pub filtered: u16,
}

/// The taxels of which `filtered`, the image of these points, lacks something, ascending by their numbers.
pub(crate) fn withheld(points: &Points, filtered: &[u16], layout: &Layout) -> Vec<WithheldTaxel, POINTS> {
    let mut taxels = Vec::new();
    for (taxel, value) in points.now() {
        let Some(filtered) = filtered.get(taxel).copied() else { continue };
        if stands_out(value, filtered) && layout.place(taxel).is_some_and(|place| is_at_edge(layout, place)) {
            // There are as many places as points.
            let _ = taxels.push(WithheldTaxel { taxel: taxel as u16, value, filtered });
        }
    }
    taxels
}

fn is_at_edge(layout: &Layout, Place { panel, row, column }: Place) -> bool {
    let area = layout.areas().get(usize::from(panel));
    let is_end = |at: u16, count: u16| at == 0 || at.saturating_add(1) == count;
    area.is_some_and(|area| is_end(row, area.rows) || is_end(column, area.columns))
}
