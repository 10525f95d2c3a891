//! Sneak paths of a passive matrix: if only the fabric joins rows and columns, current also flows from the
//! read row to the read column through three other taxels: along the row, over to another row, and along the
//! column.

use super::decode::Decoder;
use taxel_core::garment::Garment;

/// Blocks of a garment as matrices.
#[derive(Debug, Clone)]
pub(super) struct Sneak {
    blocks: Vec<Matrix>,
    /// Block, wired row and column of each taxel.
    places: Vec<Option<(usize, usize, usize)>>,
}

/// Numbers of the taxels by wired row and column.
type Matrix = Vec<Vec<usize>>;

impl Sneak {
    pub fn build(garment: &Garment, decoder: &Decoder, taxels: usize) -> Sneak {
        let (mut blocks, mut places) = (Vec::new(), vec![None; taxels]);
        for block in &garment.blocks {
            let row = |row| (0..block.columns).map(|column| decoder.taxel_of(block, row, column)).collect();
            let matrix: Matrix = (0..block.rows).map(row).collect();
            for (row, taxels) in matrix.iter().enumerate() {
                for (column, taxel) in taxels.iter().enumerate() {
                    if let Some(place) = places.get_mut(*taxel) {
                        *place = Some((blocks.len(), row, column));
                    }
                }
            }
            blocks.push(matrix);
        }
        Sneak { blocks, places }
    }

    /// Contribution of all sneak paths to a taxel, if every taxel conducts in proportion to its force: for
    /// each other row, the ways to that row in parallel, in series with the taxel from there to the column.
    /// Paths over several rows are ignored.
    pub fn newtons(&self, taxel: usize, own: impl Fn(usize) -> f32) -> f32 {
        let place = self.places.get(taxel).copied().flatten();
        let Some((matrix, row, column)) =
            place.and_then(|(b, row, column)| Some((self.blocks.get(b)?, row, column)))
        else {
            return 0.0;
        };
        let at = |row: usize, column: usize| {
            matrix.get(row).and_then(|taxels| taxels.get(column)).map_or(0.0, |taxel| own(*taxel))
        };
        let columns = matrix.first().map_or(0, Vec::len);
        // Most of a row is not pressed, and unpressed taxels do not conduct.
        let along: Vec<(usize, f32)> = (0..columns)
            .filter(|c| *c != column)
            .map(|c| (c, at(row, c)))
            .filter(|(_, n)| *n > 0.0)
            .collect();
        let others = (0..matrix.len()).filter(|other| *other != row && !along.is_empty());
        let over = |other: usize| {
            let back = at(other, column);
            let ways = || along.iter().map(|(c, there)| series(*there, at(other, *c))).sum();
            if back > 0.0 { series(ways(), back) } else { 0.0 }
        };
        others.map(over).sum()
    }
}

/// Two conductances in series.
fn series(a: f32, b: f32) -> f32 {
    if a > 0.0 && b > 0.0 { a * b / (a + b) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_corners_show_at_the_fourth() {
        let garment = Garment::block();
        let sneak = Sneak::build(&garment, &Decoder::build(&garment), 64);
        let pressed = [(3, 3.0), (11, 1.5), (48 + 3, 1.0)];
        let own = |taxel: usize| pressed.iter().find(|(t, _)| *t == taxel).map_or(0.0, |(_, n)| *n);
        for taxel in 0..64 {
            let expected = if taxel == 48 + 11 { 0.5 } else { 0.0 };
            assert!((sneak.newtons(taxel, own) - expected).abs() < 1e-6, "taxel {taxel}");
        }
    }
}
