//! Reduction of a sheet of any size to eight by eight cells.

/// Number of cells on a side.
pub const SIDE: usize = 8;

/// Number of cells of a sheet.
pub const CELLS: usize = SIDE * SIDE;

/// A frame of a sheet in cells, row after row. A cell is the sum of its taxels, halved as often as needed to
/// stay within the sum of eight taxels; at most 65,535.
pub type Cells = [u16; CELLS];

/// Mapping of a sheet of rows and columns to cells. A side shorter than eight leaves cells empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sheet {
    rows: u16,
    columns: u16,
    shift: u32,
    /// Q8
    gain: u32,
}

impl Sheet {
    /// Mapping of a sheet of that many rows and columns.
    pub const fn new(rows: u16, columns: u16) -> Sheet {
        let most = rows.div_ceil(SIDE as u16) as u32 * columns.div_ceil(SIDE as u16) as u32;
        let shift = if most > 8 { most.div_ceil(8).next_power_of_two().trailing_zeros() } else { 0 };
        Sheet { rows, columns, shift, gain: 256 }
    }

    /// Multiplies the cells by `gain`, Q8, at most 4096 (16.0).
    pub fn with_gain(self, gain: u16) -> Sheet {
        Sheet { gain: u32::from(gain.min(4096)), ..self }
    }

    /// Returns the cells of an image of rows of pressures. Missing values are 0, values beyond the sheet are
    /// ignored.
    pub fn cells(&self, image: &[u16]) -> Cells {
        let mut cells = [0; CELLS];
        let rows = image.chunks(usize::from(self.columns).max(1)).zip(SheetSide::new(self.rows));
        for (row, y) in rows {
            for (value, x) in row.iter().zip(SheetSide::new(self.columns)) {
                if let Some(cell) = cells.get_mut(y * SIDE + x) {
                    *cell += u32::from(*value);
                }
            }
        }
        // A cell holds at most eight taxels' worth: 19 bits.
        cells.map(|sum| (((sum >> self.shift) * self.gain) >> 8).min(u16::MAX.into()) as u16)
    }
}

/// Index of the cell of each taxel along a side. Without a division: the index advances whenever a cell's
/// share is full.
struct SheetSide {
    size: usize,
    share: usize,
    cell: usize,
}

impl SheetSide {
    fn new(size: u16) -> SheetSide {
        SheetSide { size: usize::from(size).max(SIDE), share: 0, cell: 0 }
    }
}

impl Iterator for SheetSide {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let cell = self.cell;
        self.share += SIDE;
        if self.share >= self.size {
            self.share -= self.size;
            self.cell += 1;
        }
        (cell < SIDE).then_some(cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_by_eight_stays_as_it_is() {
        let image: [u16; 64] = core::array::from_fn(|i| i as u16 * 1000);
        assert_eq!(Sheet::new(8, 8).cells(&image), image);
    }

    #[test]
    fn every_taxel_is_in_one_cell() {
        for (rows, columns) in [(8, 8), (16, 24), (19, 27), (64, 32), (3, 100)] {
            let sheet = Sheet::new(rows, columns);
            let image = [8 << sheet.shift; 2048];
            let image = &image[..usize::from(rows * columns)];
            let sum: u32 = sheet.cells(image).iter().map(|v| u32::from(*v)).sum();
            assert_eq!(sum, u32::from(rows * columns) * 8, "{rows} x {columns}");
        }
        // The largest of the cells of 64 x 32 taxels of 12 bits does not saturate.
        assert!(Sheet::new(64, 32).cells(&[4095; 2048]).iter().all(|v| *v == 32_760));
    }
}
