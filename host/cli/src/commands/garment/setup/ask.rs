//! Requests to the user to touch something, in words and as a picture.

use taxel_core::garment::{Block, Garment};

/// A touch with one finger.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Gesture {
    /// A stroke along a column, from the first row to the last.
    Down {
        /// The column.
        column: u16,
        /// First columns of the blocks under it.
        from: u16,
    },
    /// A stroke along a row, from the first column to the last.
    Across {
        /// The row.
        row: u16,
    },
    /// A press on row 0, column 0.
    Corner,
}

/// A touch that the user is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ask {
    /// Index of the panel.
    pub panel: usize,
    /// The touch.
    pub gesture: Gesture,
    /// Reason why the last attempt was rejected.
    pub why: Option<String>,
}

/// Width and height of a block as placed in its panel.
pub(super) fn extent(block: &Block) -> (u16, u16) {
    let (rows, columns) = (u16::from(block.rows), u16::from(block.columns));
    if block.orientation.transposed { (rows, columns) } else { (columns, rows) }
}

/// Indices of the blocks under a stroke, in its order.
pub(super) fn blocks_along(garment: &Garment, ask: &Ask) -> Vec<usize> {
    let on_the_way = |block: &Block| {
        usize::from(block.panel) == ask.panel
            && match ask.gesture {
                Gesture::Down { from, .. } => block.column == from,
                Gesture::Across { row } => (block.row..block.row + extent(block).1).contains(&row),
                Gesture::Corner => false,
            }
    };
    let blocks = garment.blocks.iter().enumerate().filter(|(_, block)| on_the_way(block));
    let mut blocks: Vec<_> = blocks.map(|(index, block)| ((block.row, block.column), index)).collect();
    blocks.sort_unstable();
    blocks.into_iter().map(|(_, index)| index).collect()
}

/// One stroke down each column of blocks of each panel. It is off the middle of the blocks, which shows their
/// orientation.
pub(super) fn strokes_down(garment: &Garment) -> Vec<Ask> {
    let mut asks = Vec::new();
    for panel in 0..garment.panels.len() {
        let mut columns: Vec<(u16, u16)> = garment
            .blocks
            .iter()
            .filter(|b| usize::from(b.panel) == panel)
            .map(|b| (b.column, extent(b).0))
            .collect();
        columns.sort_unstable();
        columns.dedup_by_key(|(from, _)| *from);
        asks.extend(columns.into_iter().map(|(from, width)| {
            let gesture = Gesture::Down { column: from + (width - 1) / 5, from };
            Ask { panel, gesture, why: None }
        }));
    }
    asks
}

/// A stroke across a panel, along the middle of its middle blocks.
pub(super) fn stroke_across(garment: &Garment, panel: usize) -> Option<Ask> {
    let mut blocks: Vec<&Block> = garment.blocks.iter().filter(|b| usize::from(b.panel) == panel).collect();
    blocks.sort_unstable_by_key(|block| block.row);
    let block = blocks.get(blocks.len() / 2)?;
    let gesture = Gesture::Across { row: block.row + (extent(block).1 - 1) / 2 };
    Some(Ask { panel, gesture, why: None })
}

impl Ask {
    /// The request in words.
    pub fn sentence(&self, garment: &Garment) -> String {
        let Some(panel) = garment.panels.get(self.panel) else { return String::new() };
        let (name, rows, columns) = (&panel.name, panel.rows, panel.columns);
        match self.gesture {
            Gesture::Down { column, .. } => format!(
                "Panel {name}: stroke with one finger along column {column} (of 0 to {}), from row 0 to row {}.",
                columns - 1,
                rows - 1
            ),
            Gesture::Across { row } => format!(
                "Panel {name}: stroke with one finger along row {row} (of 0 to {}), from column 0 to column {}.",
                rows - 1,
                columns - 1
            ),
            Gesture::Corner => format!("Panel {name}: press with one finger on row 0, column 0."),
        }
    }

    /// Picture of the panel with row 0 at the top and column 0 at the left; large panels are scaled down.
    pub fn picture(&self, garment: &Garment) -> String {
        let Some(panel) = garment.panels.get(self.panel) else { return String::new() };
        let scale = panel.rows.max(panel.columns).div_ceil(16).max(1);
        let (rows, columns) = (panel.rows.div_ceil(scale), panel.columns.div_ceil(scale));
        let sign = |row: u16, column: u16| match self.gesture {
            Gesture::Down { column: at, .. } if column == at / scale => {
                if row + 1 == rows {
                    'v'
                } else {
                    '|'
                }
            }
            Gesture::Across { row: at } if row == at / scale => {
                if column + 1 == columns {
                    '>'
                } else {
                    '-'
                }
            }
            Gesture::Corner if (row, column) == (0, 0) => 'O',
            _ => '.',
        };
        let line = |row: u16| (0..columns).flat_map(|column| [' ', sign(row, column)]).collect::<String>();
        (0..rows).map(|row| line(row) + "\n").collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_column_of_blocks_gets_a_stroke() {
        let down = |garment: &Garment| -> Vec<(usize, u16)> {
            strokes_down(garment)
                .iter()
                .map(|ask| match ask.gesture {
                    Gesture::Down { column, .. } => (ask.panel, column),
                    _ => unreachable!(),
                })
                .collect()
        };
        assert_eq!(down(&Garment::reference()), [(0, 3), (1, 3), (2, 3), (3, 3)]);
        assert_eq!(down(&Garment::mat()), [(0, 3), (0, 19)]);
        let across = stroke_across(&Garment::reference(), 2).unwrap();
        assert_eq!((across.panel, across.gesture), (2, Gesture::Across { row: 17 }));
    }

    #[test]
    fn a_picture_shows_where() {
        let garment = Garment::block();
        let ask = |gesture| Ask { panel: 0, gesture, why: None };
        assert_eq!(
            ask(Gesture::Corner).picture(&garment).lines().next().unwrap(),
            format!(" O{}", " .".repeat(15))
        );
        let across = ask(Gesture::Across { row: 1 }).picture(&garment);
        assert_eq!(across.lines().nth(1).unwrap(), format!("{} >", " -".repeat(15)));
        assert!(ask(Gesture::Corner).sentence(&garment).starts_with("Panel mat: press"));
    }
}
