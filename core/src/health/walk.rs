//! Positions of the taxels of a group.

use crate::garment::{Area, Layout};

/// A taxel and its position.
#[derive(Debug, Clone, Copy)]
pub(super) struct TaxelSpot<'a> {
    pub taxel: usize,
    /// Index of its panel.
    pub panel: u8,
    pub area: &'a Area,
    pub row: u16,
    pub column: u16,
}

/// Cursor over the rows, for taxels in ascending order: a position from a number takes a division, which an
/// M0+ does not have.
pub(super) struct Walk<'a> {
    /// Areas of the present panel and of those after it.
    areas: &'a [Area],
    panel: u8,
    row: u16,
    /// First taxel of the row.
    begin: usize,
}

impl<'a> Walk<'a> {
    /// Starts at the first taxel.
    pub fn new(layout: &'a Layout) -> Walk<'a> {
        Walk { areas: layout.areas(), panel: 0, row: 0, begin: 0 }
    }

    /// Advances to `taxel`, which is not before the last one. None past the last taxel of the garment.
    pub fn to(&mut self, taxel: usize) -> Option<TaxelSpot<'a>> {
        while let [_, rest @ ..] = self.areas
            && let [next, ..] = rest
            && taxel >= usize::from(next.base)
        {
            (self.areas, self.row, self.begin) = (rest, 0, next.base.into());
            self.panel += 1;
        }
        let area = self.areas.first()?;
        let columns = usize::from(area.columns);
        while self.row < area.rows && taxel - self.begin >= columns {
            self.begin += columns;
            self.row += 1;
        }
        let column = (taxel - self.begin) as u16;
        (self.row < area.rows).then_some(TaxelSpot { taxel, panel: self.panel, area, row: self.row, column })
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::garment::{Garment, Place};

    #[test]
    fn a_walk_finds_every_place() {
        let garment = Garment::reference();
        let layout = Layout::build(&garment, usize::from(u16::MAX), 4095).unwrap();
        assert!(layout.areas().len() > 1);
        for stride in [1, 7, 23, 300, 1500] {
            let mut walk = Walk::new(&layout);
            for taxel in (0..layout.taxels() + 600).step_by(stride) {
                let spot = walk.to(taxel);
                let place = spot.map(|TaxelSpot { panel, row, column, .. }| Place { panel, row, column });
                assert_eq!(place, layout.place(taxel), "{taxel}");
                assert!(spot.is_none_or(
                    |spot| spot.taxel == taxel && spot.area == &layout.areas()[usize::from(spot.panel)]
                ));
            }
        }
    }
}
