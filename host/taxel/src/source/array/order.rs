//! Order of the values of a frame.

use super::frame::ArrayFrame;
use taxel_core::garment::Orientation;

/// Places of a stream's values on the panel.
#[derive(Debug, Clone)]
pub struct ValueOrder {
    /// For each value of the stream: its taxel, row by row from the top left of the panel.
    taxels: Vec<usize>,
}

impl ValueOrder {
    /// Order of a panel of this size, whose stream runs back in every second line with `snake`.
    pub fn new(rows: usize, columns: usize, snake: bool, orientation: Orientation) -> ValueOrder {
        let Orientation { transposed, mirror_x, mirror_y } = orientation;
        let across = if transposed { rows } else { columns };
        let taxel = |at: usize| {
            let (line, place) = (at / across, at % across);
            let place = if snake && line % 2 == 1 { across - 1 - place } else { place };
            let (row, column) = if transposed { (place, line) } else { (line, place) };
            let row = if mirror_y { rows - 1 - row } else { row };
            let column = if mirror_x { columns - 1 - column } else { column };
            row * columns + column
        };
        ValueOrder { taxels: (0..rows * columns).map(taxel).collect() }
    }

    /// Places a stream's values in a frame.
    pub fn place(&self, values: &[f64], frame: &mut ArrayFrame) {
        frame.values.resize(self.taxels.len(), 0.0);
        for (taxel, value) in self.taxels.iter().zip(values) {
            frame.values[*taxel] = *value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_snaked_then_transposed_then_mirrored() {
        let order = |snake, [transposed, mirror_x, mirror_y]: [bool; 3]| {
            ValueOrder::new(2, 3, snake, Orientation { transposed, mirror_x, mirror_y }).taxels
        };
        assert_eq!(order(false, [false; 3]), [0, 1, 2, 3, 4, 5]);
        assert_eq!(order(true, [false; 3]), [0, 1, 2, 5, 4, 3]);
        assert_eq!(order(false, [true, false, false]), [0, 3, 1, 4, 2, 5]);
        assert_eq!(order(true, [true, false, false]), [0, 3, 4, 1, 2, 5]);
        assert_eq!(order(false, [false, true, false]), [2, 1, 0, 5, 4, 3]);
        assert_eq!(order(false, [false, false, true]), [3, 4, 5, 0, 1, 2]);
    }
}
