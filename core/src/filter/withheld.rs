//! What the filter withholds at the edges of panels.
//!
//! To the filter a panel ends at its edge. A taxel there that exceeds all of its neighbours on the panel counts
//! as an impulse until it lasts, although more may press beyond the edge, on the panel of another board. Only
//! the host knows both: it is told what was withheld, and judges.

use super::points::Points;
use crate::garment::{Layout, Place};
use serde::{Deserialize, Serialize};

/// A taxel at the edge of a panel that stands out from its neighbours, and of which the filter withholds more
/// than noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct WithheldTaxel {
    /// Number of the taxel.
    pub taxel: u16,
    /// Its pressure before the filter, counts.
    pub value: u16,
    /// Its pressure after the filter, counts.
    pub filtered: u16,
}

/// Part of what the filter leaves of a taxel that may be noise.
const NOISE: u16 = 16;

/// What the filter withholds of the last frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Withheld<'a> {
    /// Taxels that stand out from their neighbours.
    pub points: &'a Points,
    /// The image that the filter has left.
    pub filtered: &'a [u16],
}

impl Withheld<'_> {
    /// The taxels of which something is withheld at the edges of panels, ascending by their numbers.
    pub fn taxels(self, layout: &Layout) -> impl Iterator<Item = WithheldTaxel> {
        self.points.now().filter_map(move |(taxel, value)| {
            let filtered = *self.filtered.get(taxel)?;
            let is_told =
                value > filtered.saturating_add(filtered / NOISE) && is_at_edge(layout, layout.place(taxel)?);
            is_told.then_some(WithheldTaxel { taxel: taxel as u16, value, filtered })
        })
    }
}

fn is_at_edge(layout: &Layout, Place { panel, row, column }: Place) -> bool {
    let area = layout.areas().get(usize::from(panel));
    let is_end = |at: u16, count: u16| at == 0 || at.saturating_add(1) == count;
    area.is_some_and(|area| is_end(row, area.rows) || is_end(column, area.columns))
}
