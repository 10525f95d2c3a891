//! The reactions that are reflexes: what they watch and which pins they drive.

use super::agree::Agree;
use super::spot::Spot;
use crate::garment::{Layout, Line, PANELS};
use heapless::Vec;

/// Most reflexes of a scene.
pub const ROWS: usize = 8;

/// A reaction that begins by reflex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReflexRow {
    /// Index into the scene's table of reactions.
    pub index: u8,
    /// Number of taxels that must agree.
    pub agree: Agree,
    /// Least pressure of a taxel that counts, counts.
    pub level: u16,
    /// Pin that is asserted at once.
    pub output: Option<Line>,
    /// Region that is watched; none: all of them.
    pub region: Option<u8>,
}

impl ReflexRow {
    /// Bit of the row in a mask.
    pub(crate) const fn bit(&self) -> u8 {
        1 << (self.index & 7)
    }
}

/// A panel, and the row that watches it.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
struct WatchedPanel {
    base: u16,
    rows: u16,
    columns: u16,
    /// Index among the rows.
    row: Option<u8>,
}

/// All reflexes of a scene on a garment. At most one of them watches a panel.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Reflexes {
    rows: Vec<ReflexRow, ROWS>,
    panels: Vec<WatchedPanel, PANELS>,
}

impl Reflexes {
    /// No panels and no rows.
    pub const fn none() -> Reflexes {
        Reflexes { rows: Vec::new(), panels: Vec::new() }
    }

    /// The panels of a garment, without rows.
    pub fn of(layout: &Layout) -> Reflexes {
        let mut reflexes = Reflexes::none();
        for area in layout.areas() {
            let panel = WatchedPanel { base: area.base, rows: area.rows, columns: area.columns, row: None };
            let _ = reflexes.panels.push(panel); // a layout has at most PANELS of them
        }
        reflexes
    }

    /// Adds a row. Returns `false` if there is no room, or another row watches a panel of its region.
    pub fn add(&mut self, row: ReflexRow, layout: &Layout) -> bool {
        let place = self.rows.len() as u8;
        let there = self.rows.push(row).is_ok();
        let areas = layout.areas().iter().zip(&mut self.panels);
        let mut watched = areas.filter(|(area, _)| row.region.is_none_or(|region| region == area.region));
        there && watched.all(|(_, panel)| panel.row.replace(place).is_none())
    }

    /// True if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// All rows.
    pub fn rows(&self) -> &[ReflexRow] {
        &self.rows
    }

    /// Row that watches a taxel.
    pub fn row_of(&self, taxel: u16) -> Option<&ReflexRow> {
        let (panel, _) = self.find(taxel)?;
        self.rows.get(usize::from(self.panels.get(usize::from(panel))?.row?))
    }

    /// Position of a taxel.
    pub(crate) fn spot(&self, taxel: u16) -> Option<Spot> {
        let (panel, local) = self.find(taxel)?;
        let columns = self.panels.get(usize::from(panel))?.columns;
        let row = local.checked_div(columns)?;
        Some(Spot { panel, row, column: local - row * columns })
    }

    /// Returns the index of the taxel's panel, and its number within the panel.
    fn find(&self, taxel: u16) -> Option<(u8, u16)> {
        (0..).zip(&self.panels).find_map(|(index, panel)| {
            let local = taxel.checked_sub(panel.base)?;
            (u32::from(local) < u32::from(panel.rows) * u32::from(panel.columns)).then_some((index, local))
        })
    }
}
