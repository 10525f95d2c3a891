//! Places for the weights: plates that cover a panel, a block, or one taxel.

use crate::error::{Result, SettingError};
use taxel_core::garment::{Garment, Layout, Place, Rect};

/// Area covered by a plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// all taxels of a panel
    Panel,
    /// all taxels of a block
    Block,
    /// a taxel alone
    Taxel,
}

impl Over {
    /// Default weights, N.
    pub fn weights(self) -> &'static [f64] {
        match self {
            Over::Panel | Over::Block => &[5.0, 10.0, 20.0, 50.0, 100.0],
            Over::Taxel => &[0.2, 0.5, 1.0, 2.0],
        }
    }
}

/// A place of the plate, and the taxels that it presses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Plate {
    /// Name of the place.
    pub name: String,
    /// Taxels between its edges.
    pub bounds: Rect,
    /// Numbers of those that exist.
    pub taxels: Vec<u16>,
}

/// Places of the plate on a garment, in order.
pub fn plates(garment: &Garment, layout: &Layout, over: Over) -> Result<Vec<Plate>> {
    let mut found = Vec::new();
    let mut add = |name: String, bounds: Rect| {
        let taxels = covered(layout, &bounds);
        if !taxels.is_empty() {
            found.push(Plate { name, bounds, taxels });
        }
    };
    for (panel, area) in (0..).zip(layout.areas()) {
        let whole = Rect { panel, top: 0, bottom: area.rows - 1, left: 0, right: area.columns - 1 };
        match over {
            Over::Panel => add(format!("panel {}", area.name), whole),
            Over::Block => {
                for (index, block) in garment.blocks.iter().enumerate().filter(|(_, b)| b.panel == panel) {
                    let (rows, columns) = match block.orientation.transposed {
                        true => (block.columns, block.rows),
                        false => (block.rows, block.columns),
                    };
                    let bounds = Rect {
                        panel,
                        top: block.row,
                        bottom: block.row + u16::from(rows) - 1,
                        left: block.column,
                        right: block.column + u16::from(columns) - 1,
                    };
                    add(format!("block {index} of panel {}", area.name), bounds);
                }
            }
            Over::Taxel => {
                for (row, column) in (0..area.rows).flat_map(|r| (0..area.columns).map(move |c| (r, c))) {
                    let bounds = Rect { panel, top: row, bottom: row, left: column, right: column };
                    add(format!("row {row}, column {column} of panel {}", area.name), bounds);
                }
            }
        }
    }
    if found.is_empty() {
        return Err(error!(
            SettingError::Calibration,
            "garment {}: it has no taxels that a plate could cover", garment.name
        ));
    }
    Ok(found)
}

fn covered(layout: &Layout, bounds: &Rect) -> Vec<u16> {
    let panel = bounds.panel;
    let places = (bounds.top..=bounds.bottom).flat_map(|r| (bounds.left..=bounds.right).map(move |c| (r, c)));
    let there = places.filter(|(row, column)| !layout.is_absent(panel, *row, *column));
    there.filter_map(|(row, column)| layout.taxel(Place { panel, row, column }).map(|t| t as u16)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plates_cover_each_taxel_once() {
        for garment in Garment::PRESETS.iter().filter_map(|name| Garment::preset(name)) {
            let layout = Layout::build(&garment, 2048, 4095).unwrap();
            for over in [Over::Panel, Over::Block, Over::Taxel] {
                if over == Over::Block && garment.blocks.is_empty() {
                    continue;
                }
                let mut all: Vec<_> =
                    plates(&garment, &layout, over).unwrap().into_iter().flat_map(|p| p.taxels).collect();
                all.sort_unstable();
                assert!(all.is_sorted_by(|a, b| a < b), "{} {over:?}", garment.name);
                assert_eq!(all.len() + absent(&layout), layout.taxels(), "{} {over:?}", garment.name);
            }
        }
    }

    fn absent(layout: &Layout) -> usize {
        let places = (0..layout.taxels()).filter_map(|taxel| layout.place(taxel));
        places.filter(|place| layout.is_absent(place.panel, place.row, place.column)).count()
    }
}
